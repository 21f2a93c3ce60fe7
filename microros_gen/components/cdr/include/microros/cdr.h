/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_CDR_H
#define MICROROS_CDR_H

/**
 * @file Building blocks of generated encoders: CDR as ROS 2 Jazzy writes it (OMG CDR, XCDR1), little
 * endian, zero padding, positions counted from the first byte of the body.
 *
 * None of these functions checks the buffer: an encoder first refuses contents above their limits
 * (cdr_fits), so that `max_encoded_size` bytes always suffice. All functions are reentrant and keep no
 * pointer. `body` is the first byte of the body, `to` the byte to write at; neither needs any alignment.
 */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "microros/message_type.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Identifier of every type support handle that this project generates. */
#define MICROROS_TYPE_SUPPORT_IDENTIFIER "rosidl_typesupport_microros_c"

/**
 * 1 if the compiler declares the target little endian: numbers are then copied from memory unchanged. 0
 * otherwise, also if the compiler does not declare it: numbers are written byte by byte, which is correct
 * on every target.
 */
#ifndef CDR_HOST_IS_LITTLE_ENDIAN
#if defined(__BYTE_ORDER__) && defined(__ORDER_LITTLE_ENDIAN__)
#define CDR_HOST_IS_LITTLE_ENDIAN (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
#else
#define CDR_HOST_IS_LITTLE_ENDIAN 0
#endif
#endif

/**
 * Fails to compile if `condition` (a constant expression) is false; `name` appears in the compiler's
 * message. */
#define CDR_STATIC_ASSERT(name, condition) typedef char name[(condition) ? 1 : -1]

CDR_STATIC_ASSERT(cdr_assert_byte_has_8_bits, UINT8_MAX == 255U);
CDR_STATIC_ASSERT(cdr_assert_float_is_binary32, sizeof(float) == 4U);
/* On AVR a double is a float: microros/cdr_double.h. */
CDR_STATIC_ASSERT(cdr_assert_double_is_binary64, (sizeof(double) == 8U) || (sizeof(void *) == 2U));
CDR_STATIC_ASSERT(cdr_assert_character_has_16_bits, sizeof(uint_least16_t) == 2U);

/** Probe for the alignment of an 8-byte number; never instantiated. */
struct cdr_alignment_probe {
  char before;
  int64_t number;
};

/**
 * Selects one of three planned sizes by the target's data model: 64-bit pointers (LP64); 32-bit pointers
 * with 8-byte numbers aligned to 8 (ILP32: Arm, RISC-V, Xtensa) or to 4 (32-bit x86). A constant
 * expression.
 */
#define CDR_SIZE(lp64, ilp32, i386) \
  ((sizeof(void *) == 8U) ? (lp64) \
                          : ((offsetof(struct cdr_alignment_probe, number) == 8U) ? (ilp32) : (i386)))

/**
 * Selects one of four planned sizes: those of CDR_SIZE, or with 16-bit pointers and no padding (AVR). For
 * sources that are compiled for every processor. A constant expression.
 */
#define CDR_SIZE_ANY(lp64, ilp32, i386, ip16) ((sizeof(void *) == 2U) ? (ip16) : CDR_SIZE(lp64, ilp32, i386))

/**
 * Whether the members of `type` from `first` to `last`, which take `bytes` on the wire without padding,
 * have the same layout in memory. C keeps members in order and none is smaller than on the wire, so they
 * do if they span exactly as many bytes and the target is little endian. A constant expression: the
 * compiler drops one branch.
 */
#define CDR_IS_RUN(type, first, last, bytes) \
  (CDR_HOST_IS_LITTLE_ENDIAN && \
   ((offsetof(type, last) + sizeof(((const type *)0)->last)) - offsetof(type, first) == (bytes)))

/**
 * Whether an array of `type`, whose numbers take `bytes` on the wire without padding, has the same layout
 * in memory. */
#define CDR_IS_PACKED(type, bytes) (CDR_HOST_IS_LITTLE_ENDIAN && (sizeof(type) == (bytes)))

/** Fills `fault`; `found` is saturated to UINT32_MAX. Returns false. */
static inline bool cdr_refuse(
  cdr_fault_t * fault, cdr_fault_kind_t kind, const char * field, size_t found, uint32_t fits)
{
  fault->field = field;
  fault->within = NULL;
  fault->found = (found > UINT32_MAX) ? UINT32_MAX : (uint32_t)found;
  fault->fits = fits;
  fault->index = CDR_NO_INDEX;
  fault->kind = kind;
  fault->depth = 0U;
  return false;
}

/**
 * Records that the refused message is `member` of the enclosing one, or its element `index` (CDR_NO_INDEX:
 * no element). `member` must be a static string. Returns 0, the return value of an encoder that refuses.
 */
static inline uint32_t cdr_refuse_within(cdr_fault_t * fault, const char * member, size_t index)
{
  fault->within = member;
  fault->index = (index > CDR_NO_INDEX) ? CDR_NO_INDEX : (uint32_t)index;
  ++fault->depth;
  return 0U;
}

/**
 * Returns whether `size` elements (characters of a string) at `data` can be encoded: at most `limit`, and
 * `data` not NULL unless `size` is 0. Otherwise fills `fault` with `field`, which must be a static string.
 */
static inline bool cdr_fits(
  const void * data, size_t size, uint32_t limit, const char * field, cdr_fault_t * fault)
{
  if ((size <= limit) && ((data != NULL) || (size == 0U))) {
    return true;
  }
  return cdr_refuse(fault, (size <= limit) ? CDR_FAULT_DATA : CDR_FAULT_LIMIT, field, size, limit);
}

/** Same as cdr_fits for a member with a `bound` in the interface file; `limit` never exceeds it. */
static inline bool cdr_fits_bound(
  const void * data, size_t size, uint32_t limit, uint32_t bound, const char * field, cdr_fault_t * fault)
{
  const bool fits = cdr_fits(data, size, limit, field, fault);
  if ((!fits) && (size > limit) && (limit >= bound)) {
    fault->kind = CDR_FAULT_BOUND;
  }
  return fits;
}

/** Returns `position` rounded up to a multiple of `alignment` (a power of two). */
static inline uint32_t cdr_aligned(uint32_t position, uint32_t alignment)
{
  return (position + (alignment - 1U)) & ~(alignment - 1U);
}

/**
 * Writes zeros up to the next multiple of 2, 4 or 8 and returns it. Always writes 2, 4 or 8 bytes to avoid
 * a loop: a number of that size must follow.
 */
static inline uint32_t cdr_align_2(uint8_t * body, uint32_t position)
{
  (void)memset(&body[position], 0, 2U);
  return cdr_aligned(position, 2U);
}

static inline uint32_t cdr_align_4(uint8_t * body, uint32_t position)
{
  (void)memset(&body[position], 0, 4U);
  return cdr_aligned(position, 4U);
}

static inline uint32_t cdr_align_8(uint8_t * body, uint32_t position)
{
  (void)memset(&body[position], 0, 8U);
  return cdr_aligned(position, 8U);
}

/** Writes `count` zeros. */
static inline void cdr_put_zeros(uint8_t * to, size_t count)
{
  (void)memset(to, 0, count);
}

/** Copies `bytes` unchanged; `from` may be NULL if `bytes` is 0. */
static inline void cdr_copy(uint8_t * to, const void * from, size_t bytes)
{
  if (bytes > 0U) {
    (void)memcpy(to, from, bytes);
  }
}

/** Writes a number of 1, 2, 4 or 8 bytes; `from` points to it, whatever its type. */
static inline void cdr_put_1(uint8_t * to, const void * from)
{
  (void)memcpy(to, from, 1U);
}

static inline void cdr_put_2(uint8_t * to, const void * from)
{
  if (CDR_HOST_IS_LITTLE_ENDIAN) {
    (void)memcpy(to, from, 2U);
  } else {
    uint16_t value;
    (void)memcpy(&value, from, sizeof(value));
    to[0] = (uint8_t)(value & 0xFFU);
    to[1] = (uint8_t)((uint32_t)value >> 8U);
  }
}

static inline void cdr_put_4(uint8_t * to, const void * from)
{
  if (CDR_HOST_IS_LITTLE_ENDIAN) {
    (void)memcpy(to, from, 4U);
  } else {
    uint32_t value;
    (void)memcpy(&value, from, sizeof(value));
    for (uint32_t i = 0U; i < 4U; ++i) {
      to[i] = (uint8_t)((value >> (8U * i)) & 0xFFU);
    }
  }
}

static inline void cdr_put_8(uint8_t * to, const void * from)
{
  if (CDR_HOST_IS_LITTLE_ENDIAN) {
    (void)memcpy(to, from, 8U);
  } else {
    uint64_t value;
    (void)memcpy(&value, from, sizeof(value));
    for (uint32_t i = 0U; i < 8U; ++i) {
      to[i] = (uint8_t)((value >> (8U * i)) & 0xFFU);
    }
  }
}

/** Writes a bool as 0 or 1, whatever its representation in memory. */
static inline void cdr_put_bool(uint8_t * to, bool value)
{
  *to = value ? 1U : 0U;
}

/** Writes `count` consecutive numbers of 1, 2, 4 or 8 bytes. */
static inline void cdr_put_array_1(uint8_t * to, const void * from, size_t count)
{
  cdr_copy(to, from, count);
}

static inline void cdr_put_array_2(uint8_t * to, const void * from, size_t count)
{
  if (CDR_HOST_IS_LITTLE_ENDIAN) {
    cdr_copy(to, from, count * 2U);
  } else {
    for (size_t i = 0U; i < count; ++i) {
      cdr_put_2(&to[i * 2U], (const uint8_t *)from + (i * 2U));
    }
  }
}

static inline void cdr_put_array_4(uint8_t * to, const void * from, size_t count)
{
  if (CDR_HOST_IS_LITTLE_ENDIAN) {
    cdr_copy(to, from, count * 4U);
  } else {
    for (size_t i = 0U; i < count; ++i) {
      cdr_put_4(&to[i * 4U], (const uint8_t *)from + (i * 4U));
    }
  }
}

static inline void cdr_put_array_8(uint8_t * to, const void * from, size_t count)
{
  if (CDR_HOST_IS_LITTLE_ENDIAN) {
    cdr_copy(to, from, count * 8U);
  } else {
    for (size_t i = 0U; i < count; ++i) {
      cdr_put_8(&to[i * 8U], (const uint8_t *)from + (i * 8U));
    }
  }
}

/** Writes `count` bools, each as 0 or 1. */
static inline void cdr_put_array_bool(uint8_t * to, const bool * from, size_t count)
{
  for (size_t i = 0U; i < count; ++i) {
    cdr_put_bool(&to[i], from[i]);
  }
}

/** Writes the length of a sequence at `position` (a multiple of 4); returns the position after it. */
static inline uint32_t cdr_put_length(uint8_t * body, uint32_t position, size_t size)
{
  const uint32_t length = (uint32_t)size;
  cdr_put_4(&body[position], &length);
  return position + 4U;
}

/**
 * Writes a string at `position` (a multiple of 4): length with terminator, characters, terminator. Returns
 * the position after it. `data` needs no terminator and may be NULL if `size` is 0.
 */
static inline uint32_t cdr_put_string(uint8_t * body, uint32_t position, const char * data, size_t size)
{
  const uint32_t characters = cdr_put_length(body, position, size + 1U);
  const uint32_t end = characters + (uint32_t)size;
  cdr_copy(&body[characters], data, size);
  body[end] = 0U;
  return end + 1U;
}

/**
 * Writes a wide string at `position` (a multiple of 4): the number of UTF-16 units, then each unit in four
 * bytes, without a terminator, as ROS 2 Jazzy does. Returns the position after it.
 */
static inline uint32_t cdr_put_wstring(
  uint8_t * body, uint32_t position, const uint_least16_t * data, size_t size)
{
  uint32_t end = cdr_put_length(body, position, size);
  for (size_t i = 0U; i < size; ++i) {
    const uint32_t unit = data[i];
    cdr_put_4(&body[end], &unit);
    end += 4U;
  }
  return end;
}

/**
 * Writes a sequence of numbers of 1, 2, 4 or 8 bytes at `position` (a multiple of 4); returns the position
 * after it. */
static inline uint32_t cdr_put_sequence_1(uint8_t * body, uint32_t position, const void * data, size_t size)
{
  const uint32_t start = cdr_put_length(body, position, size);
  cdr_put_array_1(&body[start], data, size);
  return start + (uint32_t)size;
}

static inline uint32_t cdr_put_sequence_2(uint8_t * body, uint32_t position, const void * data, size_t size)
{
  const uint32_t start = cdr_put_length(body, position, size);
  cdr_put_array_2(&body[start], data, size);
  return start + ((uint32_t)size * 2U);
}

static inline uint32_t cdr_put_sequence_4(uint8_t * body, uint32_t position, const void * data, size_t size)
{
  const uint32_t start = cdr_put_length(body, position, size);
  cdr_put_array_4(&body[start], data, size);
  return start + ((uint32_t)size * 4U);
}

static inline uint32_t cdr_put_sequence_8(uint8_t * body, uint32_t position, const void * data, size_t size)
{
  uint32_t start = cdr_put_length(body, position, size);
  if (size > 0U) {
    start = cdr_align_8(body, start);
    cdr_put_array_8(&body[start], data, size);
  }
  return start + ((uint32_t)size * 8U);
}

static inline uint32_t cdr_put_sequence_bool(
  uint8_t * body, uint32_t position, const bool * data, size_t size)
{
  const uint32_t start = cdr_put_length(body, position, size);
  cdr_put_array_bool(&body[start], data, size);
  return start + (uint32_t)size;
}

/**
 * Writes a sequence of messages with the same layout in memory and on the wire (CDR_IS_PACKED), `element`
 * bytes each, aligned to 8 (`_8`) or less (`_4`). Returns the position after it.
 */
static inline uint32_t cdr_put_packed_4(
  uint8_t * body, uint32_t position, const void * data, size_t size, uint32_t element)
{
  const uint32_t start = cdr_put_length(body, position, size);
  cdr_copy(&body[start], data, size * (size_t)element);
  return start + ((uint32_t)size * element);
}

static inline uint32_t cdr_put_packed_8(
  uint8_t * body, uint32_t position, const void * data, size_t size, uint32_t element)
{
  uint32_t start = cdr_put_length(body, position, size);
  if (size > 0U) {
    start = cdr_align_8(body, start);
    cdr_copy(&body[start], data, size * (size_t)element);
  }
  return start + ((uint32_t)size * element);
}

/** Returns the position after a string of `size` characters that starts at `position` (a multiple of 4). */
static inline uint32_t cdr_string_end(uint32_t position, size_t size)
{
  return position + 5U + (uint32_t)size;
}

/** Returns the position after a wide string of `size` UTF-16 units that starts at `position`. */
static inline uint32_t cdr_wstring_end(uint32_t position, size_t size)
{
  return position + 4U + ((uint32_t)size * 4U);
}

/** Returns the position after a sequence of `size` elements of `element` bytes, aligned to 4 or less. */
static inline uint32_t cdr_sequence_end_4(uint32_t position, size_t size, uint32_t element)
{
  return position + 4U + ((uint32_t)size * element);
}

/** Same for elements aligned to 8. */
static inline uint32_t cdr_sequence_end_8(uint32_t position, size_t size, uint32_t element)
{
  const uint32_t start = position + 4U;
  return (size == 0U) ? start : (cdr_aligned(start, 8U) + ((uint32_t)size * element));
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_CDR_H */
