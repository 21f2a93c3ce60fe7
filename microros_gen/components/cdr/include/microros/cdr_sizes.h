/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_CDR_SIZES_H
#define MICROROS_CDR_SIZES_H

/**
 * @file
 * Where the parts of a message end that has everything full: what static assertions of generated type support
 * compare `…__MAX_ENCODED_SIZE` with. Constant expressions of 32 bits, whatever `int` has; no code comes from them.
 * `at` is the position in the body that a part is written at, behind padding that precedes it.
 */

#include <stdint.h>

/** `at`, rounded up to a multiple of `alignment`, a power of two. */
#define CDR_ALIGNED(at, alignment) (((uint32_t)(at) + ((alignment)-1U)) & ~((uint32_t)(alignment)-1U))

/** Behind a string: how many characters follow, `limit` of them, a NUL. */
#define CDR_END_OF_STRING(at, limit) ((uint32_t)(at) + 4U + (limit) + 1U)

/** Behind a wstring: how many units follow, `limit` of them. */
#define CDR_END_OF_WSTRING(at, limit) ((uint32_t)(at) + 4U + ((uint32_t)(limit)*4U))

/** Behind `count` strings (1 or more), each aligned; the length of a sequence is before `at`. */
#define CDR_END_OF_STRINGS(at, count, limit) \
  (CDR_ALIGNED(at, 4U) + (((uint32_t)(count)-1U) * CDR_ALIGNED(CDR_END_OF_STRING(0U, limit), 4U)) + \
   CDR_END_OF_STRING(0U, limit))

/** Behind `count` wstrings (1 or more), each aligned; the length of a sequence is before `at`. */
#define CDR_END_OF_WSTRINGS(at, count, limit) \
  (CDR_ALIGNED(at, 4U) + ((uint32_t)(count)*CDR_END_OF_WSTRING(0U, limit)))

/** Behind a sequence of `count` elements (1 or more) of `size` bytes without padding: its length, the elements. */
#define CDR_END_OF_SEQUENCE(at, count, size, alignment) \
  (CDR_ALIGNED((uint32_t)(at) + 4U, alignment) + ((uint32_t)(count) * (size)))

/**
 * Behind `count` messages (2 or more) of which the first ends at `first` and the second at `second`: where one ends
 * says what padding the next one has, so all behind the first take the same bytes.
 */
#define CDR_END_OF_MESSAGES(count, first, second) \
  ((uint32_t)(first) + (((uint32_t)(count)-1U) * ((uint32_t)(second) - (uint32_t)(first))))

/**
 * Behind what takes the same bytes as something equally full between `from` and `to`: it does where both begin at the
 * same position modulo the largest `alignment` in it. 0 where they do not.
 */
#define CDR_END_LIKE(at, from, to, alignment) \
  (((((uint32_t)(at) - (uint32_t)(from)) % (alignment)) == 0U) \
     ? (((uint32_t)(at) - (uint32_t)(from)) + (uint32_t)(to)) \
     : 0U)

#endif /* MICROROS_CDR_SIZES_H */
