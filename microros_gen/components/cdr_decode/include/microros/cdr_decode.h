/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_CDR_DECODE_H
#define MICROROS_CDR_DECODE_H

/**
 * @file Building blocks of generated decoders: CDR as ROS 2 Jazzy writes it (OMG CDR, XCDR1), in both byte
 * orders, positions counted from the first byte of the body.
 *
 * cdr_decode reads a message. A generated decoder calls one function per member, in order; the result is
 * checked once, at the end. A function that cannot read its member fills the fault and moves to the end of
 * the body, so that every later one reads nothing; the first fault is kept. Whatever the input, nothing is
 * read beyond `size` or written beyond a capacity: the length of a sequence is compared with the remaining
 * bytes and with the capacity before it is used. All functions are reentrant and keep no pointer.
 *
 * `field` is the name of the member for the fault: a static string. `bound` is the bound of the interface
 * file, or CDR_UNBOUNDED; the smaller of it and the message's capacity applies.
 */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/cdr.h"
#include "microros/message_type.h"
#include "rosidl_runtime_c/string.h"
#include "rosidl_runtime_c/u16string.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Bound of a string or sequence without one. */
#define CDR_UNBOUNDED UINT32_MAX

/** The body being read. `position` never exceeds `size`. */
typedef struct cdr_in_t {
  const uint8_t * body;
  uint32_t size;
  uint32_t position;
  bool swap;   /* the byte order differs from the target's */
  bool failed; /* `fault` is set */
  cdr_fault_t * fault;
} cdr_in_t;

/**
 * Reads `size` bytes at `body` into the storage of `message`, which is of `type`. `swap`: the body's byte
 * order differs from the target's. The decoder of `type` must not be NULL. Returns false if the body was
 * refused: *fault is filled, and the contents of the message are unspecified (sizes stay within
 * capacities).
 */
bool cdr_decode(
  const microros_message_type_t * type, const uint8_t * body, uint32_t size, bool swap, void * message,
  cdr_fault_t * fault);

/**
 * Whether the numbers of `type` from `first` to `last`, all of one size and `bytes` in total, are
 * contiguous in memory as on the wire. A constant expression.
 */
#define CDR_IS_ROW(type, first, last, bytes) \
  ((offsetof(type, last) + sizeof(((const type *)0)->last)) - offsetof(type, first) == (bytes))

/**
 * Whether messages of `type`, whose numbers all have one size and take `bytes` in total, are contiguous
 * likewise. */
#define CDR_IS_ROW_OF(type, bytes) (sizeof(type) == (bytes))

/**
 * Reads `count` numbers of 1, 2, 4 or 8 bytes to `to`, which has room for them and may have any type. If
 * `count` is 0, nothing is read and no padding is skipped.
 */
void cdr_get_1(cdr_in_t * in, void * to, size_t count, const char * field);
void cdr_get_2(cdr_in_t * in, void * to, size_t count, const char * field);
void cdr_get_4(cdr_in_t * in, void * to, size_t count, const char * field);
void cdr_get_8(cdr_in_t * in, void * to, size_t count, const char * field);

/** Reads `count` bools; any byte other than 0 is true, as in ROS 2. */
void cdr_get_bool(cdr_in_t * in, bool * to, size_t count, const char * field);

/**
 * Reads the length of a sequence of any type into its member `size`; 0 if it was refused. `sequence`
 * points to a struct of data, size and capacity. Each of its elements takes at least one byte.
 */
void cdr_get_size(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);

/** Reads a sequence of numbers of 1, 2, 4 or 8 bytes, or of bools; `sequence` as for cdr_get_size. */
void cdr_get_sequence_1(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);
void cdr_get_sequence_2(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);
void cdr_get_sequence_4(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);
void cdr_get_sequence_8(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);
void cdr_get_sequence_bool(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);

/**
 * Reads a string into `text`, whose `capacity` includes the terminator. As in ROS 2, the string ends at
 * its first NUL, or at its length if it contains none; a length of 0 is the empty string. A string without
 * capacity accepts only the empty string; one with a capacity of 1 is written only if its NUL is missing.
 */
void cdr_get_string(cdr_in_t * in, rosidl_runtime_c__String * text, uint32_t bound, const char * field);

/**
 * Reads a wide string: UTF-16 units of four bytes each, without a terminator. Units above 0xFFFF are
 * refused, as in ROS 2; `text` gets a terminator if it has a capacity.
 */
void cdr_get_wstring(cdr_in_t * in, rosidl_runtime_c__U16String * text, uint32_t bound, const char * field);

/** Reads `count` consecutive strings, up to the first that is refused; those after it keep what they had. */
void cdr_get_strings(
  cdr_in_t * in, rosidl_runtime_c__String * texts, size_t count, uint32_t bound, const char * field);
void cdr_get_wstrings(
  cdr_in_t * in, rosidl_runtime_c__U16String * texts, size_t count, uint32_t bound, const char * field);

/**
 * For a decoder whose nested message was just refused: records that it is `member` of this message, or its
 * element `index` (CDR_NO_INDEX: no element).
 */
void cdr_in_within(const cdr_in_t * in, const char * member, size_t index);

/**
 * For cdr_decode*.c only. cdr_in_refuse fills the fault unless it is already set, and moves to the end.
 * cdr_in_length returns a length in elements of at least `width` bytes; 0, with the fault filled, if the
 * body ends before them.
 */
void cdr_in_refuse(cdr_in_t * in, cdr_fault_kind_t kind, const char * field, uint64_t found, uint32_t fits);

/** Refuses a size above `limit`, the smaller of a capacity and a `bound`. */
void cdr_in_refuse_above(cdr_in_t * in, const char * field, uint32_t found, uint32_t limit, uint32_t bound);
uint32_t cdr_in_length(cdr_in_t * in, uint32_t width, const char * field);

/** Returns the smaller of a bound and a capacity. */
static inline uint32_t cdr_in_limit(size_t capacity, uint32_t bound)
{
  return (capacity < bound) ? (uint32_t)capacity : bound;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_CDR_DECODE_H */
