/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_CDR_DECODE_DOUBLE_H
#define MICROROS_CDR_DECODE_DOUBLE_H

/** @file Reads float64 members where a `double` has 4 bytes; microros/cdr_double.h says what is lost. */

#include "microros/cdr_decode.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Reads `count` doubles. */
void cdr_get_double(cdr_in_t * in, double * to, size_t count, const char * field);

/** Reads a sequence of doubles; `sequence` as for cdr_get_size. */
void cdr_get_sequence_double(
  cdr_in_t * in, rosidl_runtime_c__double__Sequence * sequence, uint32_t bound, const char * field);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_CDR_DECODE_DOUBLE_H */
