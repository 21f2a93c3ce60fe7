/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Memory for the strings and sequences of a message, by rules that the application gives at run time: from the storage
 * of messages that are sent (where the default allocator is asked; a capacity above the limits of the application file
 * is refused there), from another allocator, or from a buffer. (pkg__msg__Type__bind needs neither: it has the limits of the application file.)
 *
 * Capacities, for a member of variable length:
 * - the first rule that names it. A rule is the path of a member, its parts joined by points: "name",
 *   "header.frame_id"; elements of a sequence of messages have no index: "points.positions". It gives elements of a
 *   sequence, or bytes of a string. The strings of a sequence of strings have ".data" behind its path:
 *   {"joint_names", 6} and {"joint_names.data", 20} are six strings of 20 bytes;
 * - the bound in the interface file, for a string one more;
 * - the number of the configuration for its kind, or of micro_ros_utilities_memory_conf_default where that is 0.
 *
 * A capacity of a string counts the terminator: 20 bytes hold a text of 19. In a buffer, or from an allocator of the
 * application's, a rule may be above the bound of the interface file or the limits of the application file; the memory is
 * there then, and a message that uses it is refused when it is published, with the name of the member and its limit.
 *
 * `type_support` is what ROSIDL_GET_MSG_TYPE_SUPPORT gives for a type that the application declares. Every function
 * that fails leaves the reason behind rcl_get_error_string(): memory, a buffer that is too small (with the size that
 * would do), or a rule that names no string and no sequence of the type.
 *
 * No call waits; each takes time in proportion to the elements that the capacities ask for. None keeps anything: they
 * may run at the same time for different messages, as far as the allocator can.
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

/* The capacity of one member: `rule` is its path, `size` bytes of a string (the terminator included) or elements. */
typedef struct micro_ros_utilities_memory_rule_t {
  const char * rule;
  size_t size;
} micro_ros_utilities_memory_rule_t;

/* Capacities for members that no rule names (0: that of the default), the rules, and the allocator for
 * create and destroy (NULL: rcutils_get_default_allocator()). Read during a call only. */
typedef struct micro_ros_utilities_memory_conf_t {
  size_t max_string_capacity;
  size_t max_ros2_type_sequence_capacity;  /* elements of a sequence of messages */
  size_t max_basic_type_sequence_capacity; /* elements of a sequence of numbers or strings */
  const micro_ros_utilities_memory_rule_t * rules;
  size_t n_rules;
  const rcutils_allocator_t * allocator;
} micro_ros_utilities_memory_conf_t;

/* 20 bytes for a string, 5 elements for a sequence. A constant, so that an application may start its own with it. */
static const micro_ros_utilities_memory_conf_t micro_ros_utilities_memory_conf_default = {
  20, 5, 5, NULL, 0, NULL};

/*
 * Returns a text that lists the members of the type, one a line, nested ones indented by a tab more, and says which
 * need memory. It comes from the default allocator: give it back with micro_ros_string_utilities_destroy.
 * {NULL, 0, 0} when it fails.
 */
rosidl_runtime_c__String micro_ros_utilities_type_info(const rosidl_message_type_support_t * type_support);

/*
 * Returns how many bytes micro_ros_utilities_create_message_memory asks the allocator for, in all calls together;
 * 0 for a type without strings and sequences, and when it fails.
 */
size_t micro_ros_utilities_get_dynamic_size(
  const rosidl_message_type_support_t * type_support, const micro_ros_utilities_memory_conf_t conf);

/*
 * Sets the message that `ros_msg` points to, of the type of `type_support`, to zero, and gives its strings and
 * sequences memory, all zero and all of size 0. What it held before is forgotten, not freed; default values of the
 * interface file are not set. The message owns the memory: micro_ros_utilities_destroy_message_memory.
 * False when it fails: the message holds nothing then, and what had been allocated is given back.
 */
bool micro_ros_utilities_create_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf);

/*
 * Gives the memory of every string and sequence back to the allocator of `conf`, with every element up to its
 * capacity, and sets the message to zero. Only for what micro_ros_utilities_create_message_memory made; the rest of
 * `conf` does not matter. False when an argument is not valid.
 */
bool micro_ros_utilities_destroy_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf);

/*
 * Returns how many bytes of a buffer micro_ros_utilities_create_static_message_memory takes, whatever the alignment
 * of the buffer; 0 for a type without strings and sequences, and when it fails.
 */
size_t micro_ros_utilities_get_static_size(
  const rosidl_message_type_support_t * type_support, const micro_ros_utilities_memory_conf_t conf);

/*
 * As micro_ros_utilities_create_message_memory, with memory from `buffer`, `buffer_len` bytes: it belongs to the
 * application, serves one message, and must live as long as that. There is nothing to give back. False when the buffer is
 * smaller than micro_ros_utilities_get_static_size: neither it nor the message is changed then.
 */
bool micro_ros_utilities_create_static_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf, uint8_t * buffer, size_t buffer_len);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_MICRO_ROS_UTILITIES_TYPE_UTILITIES_H */
