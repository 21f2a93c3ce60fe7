/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Strings that own their characters. Memory comes from the storage of sent messages, like that of
 * rosidl_runtime_c__String__assign, and belongs to the string: free it with
 * micro_ros_string_utilities_destroy. A function that takes a string by value consumes it: continue with
 * its result, `text = micro_ros_string_utilities_append(text, "more");`.
 *
 * Without memory nothing is written: the two functions that make a string return {NULL, 0, 0}, the others
 * their argument unchanged. rcl_get_error_string() returns the reason. Characters in a buffer of the
 * application or in static storage are accepted as long as the text fits their capacity; if it does not,
 * the storage of this library gets a copy. Do not pass such strings if the application replaced the
 * default allocator.
 *
 * No call waits. Not thread-safe for the same string, nor if the allocator is not.
 */
#ifndef MICROROS_MICRO_ROS_UTILITIES_STRING_UTILITIES_H
#define MICROROS_MICRO_ROS_UTILITIES_STRING_UTILITIES_H

#include <stddef.h>

#include "micro_ros_utilities/visibility_control.h"
#include "rosidl_runtime_c/string.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Returns a string with a copy of `data` (NULL counts as empty); its capacity is at least its size plus
 * one. */
rosidl_runtime_c__String micro_ros_string_utilities_init(const char * data);

/* Returns an empty string with room for `size` bytes and the terminator, zeroed. */
rosidl_runtime_c__String micro_ros_string_utilities_init_with_size(const size_t size);

/* Replaces the text with `data`; the memory grows if needed. */
rosidl_runtime_c__String micro_ros_string_utilities_set(
  const rosidl_runtime_c__String str, const char * data);

/* Returns the characters, which belong to the string. */
const char * micro_ros_string_utilities_get_c_str(const rosidl_runtime_c__String str);

/* Appends `data`; the memory grows if needed. */
rosidl_runtime_c__String micro_ros_string_utilities_append(
  const rosidl_runtime_c__String str, const char * data);

/* Removes the last `n` bytes, or all if there are fewer. */
rosidl_runtime_c__String micro_ros_string_utilities_remove_tail_chars(
  const rosidl_runtime_c__String str, const size_t n);

/* Frees the memory; the string is {NULL, 0, 0} afterwards. NULL is ignored. */
void micro_ros_string_utilities_destroy(rosidl_runtime_c__String * const str);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_MICRO_ROS_UTILITIES_STRING_UTILITIES_H */
