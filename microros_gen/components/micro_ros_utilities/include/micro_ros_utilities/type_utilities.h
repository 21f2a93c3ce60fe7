/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Memory for strings and sequences of a message, by rules given at run time: from the storage of sent
 * messages (if the default allocator is used; it refuses capacities above the limits of the application
 * file), from another allocator, or from a buffer. (pkg__msg__Type__bind needs neither: it uses the limits
 * of the application file.)
 *
 * Capacity of a member of variable length:
 * - The first rule that names it. A rule is the path of a member, its parts joined by points: "name",
 *   "header.frame_id"; elements of a sequence of messages have no index: "points.positions". It sets the
 *   number of elements of a sequence, or the bytes of a string. For strings inside a sequence, append
 *   ".data" to its path: {"joint_names", 6} and {"joint_names.data", 20} are six strings of 20 bytes.
 * - Otherwise the bound in the interface file, plus one for a string.
 * - Otherwise the configured number for its kind, or that of micro_ros_utilities_memory_conf_default if
 *   that is 0.
 *
 * A capacity of a string includes the terminator: 20 bytes hold a text of 19. In a buffer, or with an
 * allocator of the application, a rule may exceed the bound of the interface file or the limits of the
 * application file; the memory then exists, but publishing a message that uses it fails and names the
 * member and its limit.
 *
 * `type_support` is the result of ROSIDL_GET_MSG_TYPE_SUPPORT for a type that the application declares.
 * After a failure rcl_get_error_string() returns the reason: no memory, a buffer that is too small (with
 * the required size), or a rule that names no string and no sequence of the type.
 *
 * No call waits; each takes time proportional to the elements that the capacities ask for. None keeps
 * state: they may run concurrently for different messages if the allocator permits.
 */
#ifndef MICROROS_MICRO_ROS_UTILITIES_TYPE_UTILITIES_H
#define MICROROS_MICRO_ROS_UTILITIES_TYPE_UTILITIES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "micro_ros_utilities/visibility_control.h"
#include "rcutils/allocator.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/string.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Capacity of one member: `rule` is its path, `size` the bytes of a string (including the terminator) or
 * the elements. */
typedef struct micro_ros_utilities_memory_rule_t {
  const char * rule;
  size_t size;
} micro_ros_utilities_memory_rule_t;

/* Capacities for members that no rule names (0: the default's), the rules, and the allocator for create
 * and destroy (NULL: rcutils_get_default_allocator()). Read only during a call. */
typedef struct micro_ros_utilities_memory_conf_t {
  size_t max_string_capacity;
  size_t max_ros2_type_sequence_capacity;  /* elements of a sequence of messages */
  size_t max_basic_type_sequence_capacity; /* elements of a sequence of numbers or strings */
  const micro_ros_utilities_memory_rule_t * rules;
  size_t n_rules;
  const rcutils_allocator_t * allocator;
} micro_ros_utilities_memory_conf_t;

/*
 * 20 bytes for a string, 5 elements for a sequence. A constant, so that an application can copy and change
 * it. */
static const micro_ros_utilities_memory_conf_t micro_ros_utilities_memory_conf_default = {
  20, 5, 5, NULL, 0, NULL};

/*
 * Returns a text that lists the members of the type, one per line, nested ones indented by a further tab,
 * and says which need memory. It comes from the default allocator: free it with
 * micro_ros_string_utilities_destroy. {NULL, 0, 0} on failure.
 */
rosidl_runtime_c__String micro_ros_utilities_type_info(const rosidl_message_type_support_t * type_support);

/*
 * Returns the total number of bytes that micro_ros_utilities_create_message_memory requests from the
 * allocator; 0 for a type without strings and sequences, and on failure.
 */
size_t micro_ros_utilities_get_dynamic_size(
  const rosidl_message_type_support_t * type_support, const micro_ros_utilities_memory_conf_t conf);

/*
 * Zeroes the message at `ros_msg`, of the type of `type_support`, and allocates memory for its strings and
 * sequences, all zero and of size 0. Previous contents are overwritten without being freed; default values
 * of the interface file are not set. The message owns the memory: free it with
 * micro_ros_utilities_destroy_message_memory. Returns false on failure: the message is then empty, and
 * everything allocated was freed.
 */
bool micro_ros_utilities_create_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf);

/*
 * Frees the memory of every string and sequence with the allocator of `conf`, including every element up
 * to its capacity, and zeroes the message. Only for messages made by
 * micro_ros_utilities_create_message_memory; the rest of `conf` is ignored. Returns false for an invalid
 * argument.
 */
bool micro_ros_utilities_destroy_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf);

/*
 * Returns the number of bytes that micro_ros_utilities_create_static_message_memory takes from a buffer of
 * any alignment; 0 for a type without strings and sequences, and on failure.
 */
size_t micro_ros_utilities_get_static_size(
  const rosidl_message_type_support_t * type_support, const micro_ros_utilities_memory_conf_t conf);

/*
 * As micro_ros_utilities_create_message_memory, with memory from `buffer` of `buffer_len` bytes. The
 * buffer belongs to the application, serves one message, and must outlive it. Nothing has to be freed.
 * Returns false, with buffer and message unchanged, if the buffer is smaller than
 * micro_ros_utilities_get_static_size.
 */
bool micro_ros_utilities_create_static_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf, uint8_t * buffer, size_t buffer_len);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_MICRO_ROS_UTILITIES_TYPE_UTILITIES_H */
