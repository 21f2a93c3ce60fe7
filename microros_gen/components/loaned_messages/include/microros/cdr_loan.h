/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Strings and sequences that are used where they are in the body. The body belongs to the library, so they are made
 * valid there: numbers are turned into the byte order of the target and moved to their alignment, over the length
 * before them; a string without its terminator is moved by one byte. Internal.
 */
#ifndef MICROROS_CDR_LOAN_H
#define MICROROS_CDR_LOAN_H

#include <stdbool.h>

#include "microros/cdr_decode.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Reads `size` bytes at `body`, which is aligned to 4 and may be changed, as cdr_decode does; `message` then points
 * into it. Not reentrant: the lock is held. */
bool cdr_loan_decode(
  const microros_message_type_t * type, uint8_t * body, uint32_t size, bool swap, void * message,
  cdr_fault_t * fault);

/* Returns whether the string points into the body, or was refused, instead of being copied. */
bool cdr_loan_string(cdr_in_t * in, rosidl_runtime_c__String * text, uint32_t bound, const char * field);

/* Same for a sequence of numbers of `width` bytes. */
bool cdr_loan_sequence(cdr_in_t * in, void * sequence, uint32_t bound, uint32_t width, const char * field);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_CDR_LOAN_H */
