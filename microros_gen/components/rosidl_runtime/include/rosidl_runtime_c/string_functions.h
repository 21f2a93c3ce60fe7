/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions on strings. A buffer with room enough is filled in place, whoever supplied it. Where more is needed, the
 * string gets a block of the storage that the build plans for messages which are sent: `memory.messages` of each
 * declared sender, under its `limits`; or memory of the allocator that rcutils_set_default_allocator set. The string owns
 * it until __fini. An empty string needs none: it points to a NUL that all share, with a capacity of 1; threads share
 * it too, so nothing writes to it, a decoder neither. Every function returns false for a NULL string, for a text that is
 * longer than any limit of a message that is sent, and when all blocks are taken; the string then still holds what it
 * held before, the reason is behind rcl_get_error_string(), and rmw_uros_get_refused_memory() counts it. No call waits.
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

/* Gives the block back and leaves the string without any; a buffer of the user's is left alone. */
void rosidl_runtime_c__String__fini(rosidl_runtime_c__String * str);

/* As in ROS 2, `input` needs data: a string of zeros, which nobody initialized, is refused, whatever its size. */
bool rosidl_runtime_c__String__copy(
  const rosidl_runtime_c__String * input, rosidl_runtime_c__String * output);

bool rosidl_runtime_c__String__are_equal(
  const rosidl_runtime_c__String * lhs, const rosidl_runtime_c__String * rhs);

/* Copies `n` bytes of `value` and terminates them; `capacity` may be above `n` + 1 then. False for a NULL `value`, also where `n` is 0, as in ROS 2. */
bool rosidl_runtime_c__String__assignn(rosidl_runtime_c__String * str, const char * value, size_t n);

bool rosidl_runtime_c__String__assign(rosidl_runtime_c__String * str, const char * value);

bool rosidl_runtime_c__String__Sequence__init(rosidl_runtime_c__String__Sequence * sequence, size_t size);

void rosidl_runtime_c__String__Sequence__fini(rosidl_runtime_c__String__Sequence * sequence);

bool rosidl_runtime_c__String__Sequence__are_equal(
  const rosidl_runtime_c__String__Sequence * lhs, const rosidl_runtime_c__String__Sequence * rhs);

bool rosidl_runtime_c__String__Sequence__copy(
  const rosidl_runtime_c__String__Sequence * input, rosidl_runtime_c__String__Sequence * output);

/* Returns a sequence of `size` empty strings that rosidl_runtime_c__String__Sequence__destroy gives back, or
 * NULL. The sequence itself lies in `memory.arena`. */
rosidl_runtime_c__String__Sequence * rosidl_runtime_c__String__Sequence__create(size_t size);

void rosidl_runtime_c__String__Sequence__destroy(rosidl_runtime_c__String__Sequence * sequence);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ROSIDL_RUNTIME_C_STRING_FUNCTIONS_H */
