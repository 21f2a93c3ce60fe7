/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_CDR_SIZES_H
#define MICROROS_CDR_SIZES_H

/**
 * @file End positions of the parts of a message with maximum contents. Static assertions of generated type
 * support compare them with `…__MAX_ENCODED_SIZE`. 32-bit constant expressions, whatever the width of
 * `int`; they generate no code. `at` is the position in the body where a part starts, after the padding
 * that precedes it.
 */

#include <stdint.h>

/** `at`, rounded up to a multiple of `alignment`, a power of two. */
#define CDR_ALIGNED(at, alignment) (((uint32_t)(at) + ((alignment)-1U)) & ~((uint32_t)(alignment)-1U))

/** End of a string: its length, `limit` characters, a NUL. */
#define CDR_END_OF_STRING(at, limit) ((uint32_t)(at) + 4U + (limit) + 1U)

/** End of a wstring: its length, `limit` units. */
#define CDR_END_OF_WSTRING(at, limit) ((uint32_t)(at) + 4U + ((uint32_t)(limit)*4U))

/** End of `count` strings (1 or more), each aligned; the length of a sequence precedes `at`. */
#define CDR_END_OF_STRINGS(at, count, limit) \
  (CDR_ALIGNED(at, 4U) + (((uint32_t)(count)-1U) * CDR_ALIGNED(CDR_END_OF_STRING(0U, limit), 4U)) + \
   CDR_END_OF_STRING(0U, limit))

/** End of `count` wstrings (1 or more), each aligned; the length of a sequence precedes `at`. */
#define CDR_END_OF_WSTRINGS(at, count, limit) \
  (CDR_ALIGNED(at, 4U) + ((uint32_t)(count)*CDR_END_OF_WSTRING(0U, limit)))

/**
 * End of a sequence of `count` elements (1 or more) of `size` bytes without padding: its length, the
 * elements. */
#define CDR_END_OF_SEQUENCE(at, count, size, alignment) \
  (CDR_ALIGNED((uint32_t)(at) + 4U, alignment) + ((uint32_t)(count) * (size)))

/**
 * End of `count` messages (2 or more), the first of which ends at `first` and the second at `second`. The
 * end of one determines the padding of the next, so that all but the first take the same number of bytes.
 */
#define CDR_END_OF_MESSAGES(count, first, second) \
  ((uint32_t)(first) + (((uint32_t)(count)-1U) * ((uint32_t)(second) - (uint32_t)(first))))

/**
 * End of a part that takes as many bytes as an identical one between `from` and `to`. That holds if both
 * start at the same position modulo the largest `alignment` in it; otherwise the result is 0.
 */
#define CDR_END_LIKE(at, from, to, alignment) \
  (((((uint32_t)(at) - (uint32_t)(from)) % (alignment)) == 0U) \
     ? (((uint32_t)(at) - (uint32_t)(from)) + (uint32_t)(to)) \
     : 0U)

#endif /* MICROROS_CDR_SIZES_H */
