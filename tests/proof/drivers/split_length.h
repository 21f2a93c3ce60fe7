/* SPDX-License-Identifier: Apache-2.0 */
/* Put before the primitives of texts (-include): one state for each length of a text. Nothing is assumed of it. */
#ifndef SPLIT_LENGTH_H
#define SPLIT_LENGTH_H

#include "microros/cdr_decode.h"

extern uint32_t proof_length;

static inline uint32_t proof_in_length(cdr_in_t * in, uint32_t width, const char * field)
{
  proof_length = cdr_in_length(in, width, field);
  //@ split proof_length;
  return proof_length;
}

#define cdr_in_length proof_in_length

#endif /* SPLIT_LENGTH_H */
