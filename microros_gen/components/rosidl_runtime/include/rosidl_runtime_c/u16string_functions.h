/* SPDX-License-Identifier: Apache-2.0 */
/* Functions on strings of UTF-16 units; memory and results as in string_functions.h. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_U16STRING_FUNCTIONS_H
#define MICROROS_ROSIDL_RUNTIME_C_U16STRING_FUNCTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rosidl_runtime_c/u16string.h"
#include "rosidl_runtime_c/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

bool rosidl_runtime_c__U16String__init(rosidl_runtime_c__U16String * str);

void rosidl_runtime_c__U16String__fini(rosidl_runtime_c__U16String * str);

bool rosidl_runtime_c__U16String__are_equal(
  const rosidl_runtime_c__U16String * lhs, const rosidl_runtime_c__U16String * rhs);

bool rosidl_runtime_c__U16String__copy(
  const rosidl_runtime_c__U16String * input, rosidl_runtime_c__U16String * output);

/* Copies `n` units of `value` and terminates them. */
bool rosidl_runtime_c__U16String__assignn(
  rosidl_runtime_c__U16String * str, const uint16_t * value, size_t n);

/* Copies `n` units from memory that holds them as bytes of any alignment. */
bool rosidl_runtime_c__U16String__assignn_from_char(
  rosidl_runtime_c__U16String * str, const char * value, size_t n);

bool rosidl_runtime_c__U16String__assign(rosidl_runtime_c__U16String * str, const uint16_t * value);

/* Returns the number of units before the terminating zero. */
size_t rosidl_runtime_c__U16String__len(const uint16_t * value);

/* Resizes the string to `n` units; new units are zero. */
bool rosidl_runtime_c__U16String__resize(rosidl_runtime_c__U16String * str, size_t n);

bool rosidl_runtime_c__U16String__Sequence__init(
  rosidl_runtime_c__U16String__Sequence * sequence, size_t size);

void rosidl_runtime_c__U16String__Sequence__fini(rosidl_runtime_c__U16String__Sequence * sequence);

bool rosidl_runtime_c__U16String__Sequence__are_equal(
  const rosidl_runtime_c__U16String__Sequence * lhs, const rosidl_runtime_c__U16String__Sequence * rhs);

bool rosidl_runtime_c__U16String__Sequence__copy(
  const rosidl_runtime_c__U16String__Sequence * input, rosidl_runtime_c__U16String__Sequence * output);

/* Returns `size` empty strings, freed by rosidl_runtime_c__U16String__Sequence__destroy, or NULL. */
rosidl_runtime_c__U16String__Sequence * rosidl_runtime_c__U16String__Sequence__create(size_t size);

void rosidl_runtime_c__U16String__Sequence__destroy(rosidl_runtime_c__U16String__Sequence * sequence);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ROSIDL_RUNTIME_C_U16STRING_FUNCTIONS_H */
