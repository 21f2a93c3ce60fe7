/* SPDX-License-Identifier: Apache-2.0 */
/* Whether strings and sequences are used where they are in the body: never, unless a component replaces this header.
 * Internal. */
#ifndef MICROROS_CDR_LOAN_H
#define MICROROS_CDR_LOAN_H

#include <stdbool.h>

#include "microros/cdr_decode.h"

/* Returns whether the string points into the body, or was refused, instead of being copied. */
static inline bool cdr_loan_string(
  cdr_in_t * in, rosidl_runtime_c__String * text, uint32_t bound, const char * field)
{
  (void)in;
  (void)text;
  (void)bound;
  (void)field;
  return false;
}

/* Same for a sequence of numbers of `width` bytes. */
static inline bool cdr_loan_sequence(
  cdr_in_t * in, void * sequence, uint32_t bound, uint32_t width, const char * field)
{
  (void)in;
  (void)sequence;
  (void)bound;
  (void)width;
  (void)field;
  return false;
}

#endif /* MICROROS_CDR_LOAN_H */
