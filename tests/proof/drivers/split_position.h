/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Put before a decoder by the preprocessor (-include): after each member the analyzer continues with one state for each
 * position in the body, since "position + left = size" is a relation, which intervals do not keep. What is called is
 * the primitive itself; nothing is assumed.
 */
#ifndef SPLIT_POSITION_H
#define SPLIT_POSITION_H

#include "microros/cdr_decode.h"

extern uint32_t proof_position;
extern uint32_t proof_length;

static inline void proof_split(const cdr_in_t * in)
{
  //@ merge proof_length;
  proof_position = in->position;
  //@ split proof_position;
}

#define PROOF_NUMBERS(name, type) \
  static inline void proof_##name(cdr_in_t * in, type * to, size_t count, const char * field) \
  { \
    name(in, to, count, field); \
    proof_split(in); \
  }

#define PROOF_MEMBER(name, type) \
  static inline void proof_##name(cdr_in_t * in, type * to, uint32_t bound, const char * field) \
  { \
    name(in, to, bound, field); \
    proof_split(in); \
  }

#define PROOF_ARRAY(name, type, one) \
  static inline void proof_##name(cdr_in_t * in, type * to, size_t count, uint32_t bound, const char * field) \
  { \
    for (size_t i = 0; i < count; ++i) { \
      proof_##one(in, &to[i], bound, field); \
    } \
  }

PROOF_NUMBERS(cdr_get_1, void)
PROOF_NUMBERS(cdr_get_2, void)
PROOF_NUMBERS(cdr_get_4, void)
PROOF_NUMBERS(cdr_get_8, void)
PROOF_NUMBERS(cdr_get_bool, bool)
PROOF_MEMBER(cdr_get_size, void)
PROOF_MEMBER(cdr_get_sequence_1, void)
PROOF_MEMBER(cdr_get_sequence_2, void)
PROOF_MEMBER(cdr_get_sequence_4, void)
PROOF_MEMBER(cdr_get_sequence_8, void)
PROOF_MEMBER(cdr_get_sequence_bool, void)
PROOF_MEMBER(cdr_get_string, rosidl_runtime_c__String)
PROOF_MEMBER(cdr_get_wstring, rosidl_runtime_c__U16String)
PROOF_ARRAY(cdr_get_strings, rosidl_runtime_c__String, cdr_get_string)
PROOF_ARRAY(cdr_get_wstrings, rosidl_runtime_c__U16String, cdr_get_wstring)

#define cdr_get_1 proof_cdr_get_1
#define cdr_get_2 proof_cdr_get_2
#define cdr_get_4 proof_cdr_get_4
#define cdr_get_8 proof_cdr_get_8
#define cdr_get_bool proof_cdr_get_bool
#define cdr_get_size proof_cdr_get_size
#define cdr_get_sequence_1 proof_cdr_get_sequence_1
#define cdr_get_sequence_2 proof_cdr_get_sequence_2
#define cdr_get_sequence_4 proof_cdr_get_sequence_4
#define cdr_get_sequence_8 proof_cdr_get_sequence_8
#define cdr_get_sequence_bool proof_cdr_get_sequence_bool
#define cdr_get_string proof_cdr_get_string
#define cdr_get_wstring proof_cdr_get_wstring
#define cdr_get_strings proof_cdr_get_strings
#define cdr_get_wstrings proof_cdr_get_wstrings

#endif /* SPLIT_POSITION_H */
