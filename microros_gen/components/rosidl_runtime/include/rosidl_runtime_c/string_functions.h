/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions on strings. A buffer with enough room is filled in place, whoever supplied it. Otherwise the
 * string gets a block of the storage that the build plans for sent messages (`memory.messages` of each
 * declared sender, within its `limits`), or memory of the allocator set by rcutils_set_default_allocator.
 * The string owns it until __fini. An empty string needs none: it points to a shared NUL with a capacity
 * of 1; threads share it, so no function writes to it, not even a decoder. Every function returns false
 * for a NULL string, for a text longer than any limit of a sent message, and if all blocks are in use; the
 * string then keeps its contents, rcl_get_error_string() returns the reason, and
 * rmw_uros_get_refused_memory() counts it. No call waits.
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

/* Frees the block and leaves the string without memory; ignores a buffer of the user. */
void rosidl_runtime_c__String__fini(rosidl_runtime_c__String * str);

/* As in ROS 2, `input` needs data: a zeroed, uninitialized string is refused, whatever its size. */
bool rosidl_runtime_c__String__copy(
  const rosidl_runtime_c__String * input, rosidl_runtime_c__String * output);

bool rosidl_runtime_c__String__are_equal(
  const rosidl_runtime_c__String * lhs, const rosidl_runtime_c__String * rhs);

/*
 * Copies `n` bytes of `value` and terminates them; `capacity` may then exceed `n` + 1. Returns false for a
 * NULL `value`, even if `n` is 0, as in ROS 2. */
bool rosidl_runtime_c__String__assignn(rosidl_runtime_c__String * str, const char * value, size_t n);

bool rosidl_runtime_c__String__assign(rosidl_runtime_c__String * str, const char * value);

bool rosidl_runtime_c__String__Sequence__init(rosidl_runtime_c__String__Sequence * sequence, size_t size);

void rosidl_runtime_c__String__Sequence__fini(rosidl_runtime_c__String__Sequence * sequence);

bool rosidl_runtime_c__String__Sequence__are_equal(
  const rosidl_runtime_c__String__Sequence * lhs, const rosidl_runtime_c__String__Sequence * rhs);

bool rosidl_runtime_c__String__Sequence__copy(
  const rosidl_runtime_c__String__Sequence * input, rosidl_runtime_c__String__Sequence * output);

/* Returns a sequence of `size` empty strings, freed by rosidl_runtime_c__String__Sequence__destroy, or
 * NULL. The sequence itself is in `memory.arena`. */
rosidl_runtime_c__String__Sequence * rosidl_runtime_c__String__Sequence__create(size_t size);

void rosidl_runtime_c__String__Sequence__destroy(rosidl_runtime_c__String__Sequence * sequence);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ROSIDL_RUNTIME_C_STRING_FUNCTIONS_H */
