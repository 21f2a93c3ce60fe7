/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Strings that own their characters. Memory comes from the storage of messages that are sent, as that of
 * rosidl_runtime_c__String__assign, and belongs to the string: micro_ros_string_utilities_destroy gives it back. A function that takes a string by value consumes it: go on with
 * what it returns, `text = micro_ros_string_utilities_append(text, "more");`.
 *
 * Without memory nothing is written: the two that make a string return {NULL, 0, 0}, the others the string that
 * they were given, unchanged. The reason is behind rcl_get_error_string(). Characters that lie in a buffer of the
 * application, or in static storage, may be given as long as the text fits their capacity; where it does not, the
 * storage of this library gets a copy; an allocator that the application set must not be given them.
 *
 * No call waits. Not thread-safe for the same string, nor where the allocator is not.
 */
#ifndef MICROROS_MICRO_ROS_UTILITIES_STRING_UTILITIES_H
#define MICROROS_MICRO_ROS_UTILITIES_STRING_UTILITIES_H

#include <stddef.h>

#include "micro_ros_utilities/visibility_control.h"
#include "rosidl_runtime_c/string.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns a string with a copy of `data` (NULL counts as empty); its capacity is at least one more than its size. */
rosidl_runtime_c__String micro_ros_string_utilities_init(const char * data);

/* Returns an empty string with room for `size` bytes and the terminator, all zero. */
rosidl_runtime_c__String micro_ros_string_utilities_init_with_size(const size_t size);

/* Replaces the text with `data`; the memory grows where it has to. */
rosidl_runtime_c__String micro_ros_string_utilities_set(
  const rosidl_runtime_c__String str, const char * data);

/* Returns the characters, which belong to the string. */
const char * micro_ros_string_utilities_get_c_str(const rosidl_runtime_c__String str);

/* Adds `data` to the end; the memory grows where it has to. */
rosidl_runtime_c__String micro_ros_string_utilities_append(
  const rosidl_runtime_c__String str, const char * data);

/* Removes the last `n` bytes, or all where there are not as many. */
rosidl_runtime_c__String micro_ros_string_utilities_remove_tail_chars(
  const rosidl_runtime_c__String str, const size_t n);

/* Gives the memory back; the string is {NULL, 0, 0} then. NULL is ignored. */
void micro_ros_string_utilities_destroy(rosidl_runtime_c__String * const str);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_MICRO_ROS_UTILITIES_STRING_UTILITIES_H */
