/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions on strings. Where more room is needed than the string has, the default allocator supplies it; a
 * buffer with room enough is kept, whoever supplied it. An empty string needs no memory: it points to a NUL
 * that all share, with a capacity of 1; threads share it too, so nothing writes to it, a decoder neither. Every
 * function returns false for a NULL string, and when no memory was left; the string then still holds what it
 * held before.
 */
#ifndef MICROROS_ROSIDL_RUNTIME_C_STRING_FUNCTIONS_H
#define MICROROS_ROSIDL_RUNTIME_C_STRING_FUNCTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "rosidl_runtime_c/string.h"
#include "rosidl_runtime_c/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

bool rosidl_runtime_c__String__init(rosidl_runtime_c__String * str);

/* Gives the memory back and leaves the string without any; the arena leaves a buffer of the user's alone. */
void rosidl_runtime_c__String__fini(rosidl_runtime_c__String * str);

/* As in ROS 2, `input` needs data: a string of zeros, which nobody initialized, is refused, whatever its size. */
bool rosidl_runtime_c__String__copy(
  const rosidl_runtime_c__String * input, rosidl_runtime_c__String * output);

bool rosidl_runtime_c__String__are_equal(
  const rosidl_runtime_c__String * lhs, const rosidl_runtime_c__String * rhs);

/* Copies `n` bytes of `value` and terminates them; false for a NULL `value`, also where `n` is 0, as in ROS 2. */
bool rosidl_runtime_c__String__assignn(rosidl_runtime_c__String * str, const char * value, size_t n);

bool rosidl_runtime_c__String__assign(rosidl_runtime_c__String * str, const char * value);

bool rosidl_runtime_c__String__Sequence__init(rosidl_runtime_c__String__Sequence * sequence, size_t size);

void rosidl_runtime_c__String__Sequence__fini(rosidl_runtime_c__String__Sequence * sequence);

bool rosidl_runtime_c__String__Sequence__are_equal(
  const rosidl_runtime_c__String__Sequence * lhs, const rosidl_runtime_c__String__Sequence * rhs);

bool rosidl_runtime_c__String__Sequence__copy(
  const rosidl_runtime_c__String__Sequence * input, rosidl_runtime_c__String__Sequence * output);

/* Returns a sequence of `size` empty strings that rosidl_runtime_c__String__Sequence__destroy gives back, or
 * NULL. */
rosidl_runtime_c__String__Sequence * rosidl_runtime_c__String__Sequence__create(size_t size);

void rosidl_runtime_c__String__Sequence__destroy(rosidl_runtime_c__String__Sequence * sequence);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ROSIDL_RUNTIME_C_STRING_FUNCTIONS_H */
