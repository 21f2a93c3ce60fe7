/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_CDR_DECODE_H
#define MICROROS_CDR_DECODE_H

/**
 * @file
 * The parts that generated decoders are made of: CDR as ROS 2 Jazzy writes it (OMG CDR, XCDR1), in both byte
 * orders, positions counted from the first byte of the body.
 *
 * cdr_decode reads a message. A generated decoder calls one function for each member, in order; the result is
 * looked at once, at the end. A function
 * that cannot read its member fills the fault and moves to the end of the body, so that every later one reads
 * nothing; the first fault stays. Whatever the bytes, nothing is read behind `size` nor written behind a
 * capacity, and the length of a sequence is compared with the bytes that are left and with the capacity before
 * anything is done with it. All functions are reentrant; none keeps a pointer.
 *
 * `field` is the name of the member for the fault: a static string. `bound` is the bound of the interface file,
 * or CDR_UNBOUNDED; the smaller one of it and of the message's capacity holds.
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

/** The bound of a string or sequence without one. */
#define CDR_UNBOUNDED UINT32_MAX

/** The body that is being read. `position` is never above `size`. */
typedef struct cdr_in_t {
  const uint8_t * body;
  uint32_t size;
  uint32_t position;
  bool swap;   /* numbers are in the other byte order than this target's */
  bool failed; /* `fault` is filled */
  cdr_fault_t * fault;
} cdr_in_t;

/**
 * Read `size` bytes at `body`, `swap` where they are big endian on a little endian target or the reverse, into the
 * storage that `message`, which is of `type`, has. The decoder of `type` must not be NULL. False: refused, *fault is
 * filled, and the contents of the message are unspecified (sizes stay within capacities).
 */
bool cdr_decode(
  const microros_message_type_t * type, const uint8_t * body, uint32_t size, bool swap, void * message,
  cdr_fault_t * fault);

/**
 * Whether the numbers of `type` from `first` to `last`, all of one size and `bytes` together, lie in memory one
 * after the other as they do on the wire. A constant expression.
 */
#define CDR_IS_ROW(type, first, last, bytes) \
  ((offsetof(type, last) + sizeof(((const type *)0)->last)) - offsetof(type, first) == (bytes))

/** Whether messages of `type`, whose numbers all have one size and `bytes` together, lie in memory likewise. */
#define CDR_IS_ROW_OF(type, bytes) (sizeof(type) == (bytes))

/**
 * Read `count` numbers of 1, 2, 4 or 8 bytes to `to`, which has room for them and may have any type. Nothing is
 * read, and no padding passed over, when `count` is 0.
 */
void cdr_get_1(cdr_in_t * in, void * to, size_t count, const char * field);
void cdr_get_2(cdr_in_t * in, void * to, size_t count, const char * field);
void cdr_get_4(cdr_in_t * in, void * to, size_t count, const char * field);
void cdr_get_8(cdr_in_t * in, void * to, size_t count, const char * field);

/** Read `count` bools; any byte but 0 is true, as for ROS 2. */
void cdr_get_bool(cdr_in_t * in, bool * to, size_t count, const char * field);

/**
 * Read the length of a sequence, of whatever type, into its member `size`: 0 when it was refused. `sequence`
 * points to a struct of data, size and capacity. Each of its elements takes at least one byte.
 */
void cdr_get_size(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);

/** Read a sequence of numbers of 1, 2, 4 or 8 bytes, or of bools; `sequence` as for cdr_get_size. */
void cdr_get_sequence_1(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);
void cdr_get_sequence_2(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);
void cdr_get_sequence_4(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);
void cdr_get_sequence_8(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);
void cdr_get_sequence_bool(cdr_in_t * in, void * sequence, uint32_t bound, const char * field);

/**
 * Read a string into `text`, whose `capacity` counts the terminator. As for ROS 2, the string ends at its first
 * NUL, or where its length says when there is none; a length of 0 is the empty string. A string without capacity
 * takes the empty string only; one with a capacity of 1 is written to where it does not hold the NUL yet.
 */
void cdr_get_string(cdr_in_t * in, rosidl_runtime_c__String * text, uint32_t bound, const char * field);

/**
 * Read a wide string: UTF-16 units of four bytes each, without terminator. Units above 0xFFFF are refused, as
 * ROS 2 does; `text` gets a terminator where it has a capacity.
 */
void cdr_get_wstring(cdr_in_t * in, rosidl_runtime_c__U16String * text, uint32_t bound, const char * field);

/** Read `count` strings one after the other. */
void cdr_get_strings(
  cdr_in_t * in, rosidl_runtime_c__String * texts, size_t count, uint32_t bound, const char * field);
void cdr_get_wstrings(
  cdr_in_t * in, rosidl_runtime_c__U16String * texts, size_t count, uint32_t bound, const char * field);

/**
 * For a decoder whose nested message has just failed: the one that was refused is `member` of this message, or its
 * element `index` (CDR_NO_INDEX: no element).
 */
void cdr_in_within(const cdr_in_t * in, const char * member, size_t index);

/**
 * For cdr_decode*.c. cdr_in_refuse fills the fault, if there is none yet, and moves to the end. cdr_in_length returns
 * a length in elements of at least `width` bytes; 0, with the fault filled, where the body ends before them.
 */
void cdr_in_refuse(cdr_in_t * in, cdr_fault_kind_t kind, const char * field, uint64_t found, uint32_t fits);

/** Refuse what is above `limit`, the smaller one of a capacity and a `bound`. */
void cdr_in_refuse_above(cdr_in_t * in, const char * field, uint32_t found, uint32_t limit, uint32_t bound);
uint32_t cdr_in_length(cdr_in_t * in, uint32_t width, const char * field);

/** The smaller one of a bound and a capacity. */
static inline uint32_t cdr_in_limit(size_t capacity, uint32_t bound)
{
  return (capacity < bound) ? (uint32_t)capacity : bound;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_CDR_DECODE_H */
