/* SPDX-License-Identifier: Apache-2.0 */
/* Publishers. */
#ifndef MICROROS_RCL_PUBLISHER_H
#define MICROROS_RCL_PUBLISHER_H

#include <stdbool.h>
#include <stddef.h>

#include "rcl/macros.h"
#include "rcl/node.h"
#include "rcl/time.h"
#include "rcl/visibility_control.h"
#include "rmw/qos_profiles.h"
#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_publisher_s rcl_publisher_impl_t;

typedef struct rcl_publisher_s {
  rcl_publisher_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_publisher_t;

typedef struct rcl_publisher_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
  rmw_publisher_options_t rmw_publisher_options;
  bool disable_loaned_message;
} rcl_publisher_options_t;

rcl_publisher_t rcl_get_zero_initialized_publisher(void);

/*
 * Waits for the agent, at most MICROROS_CREATE_TIMEOUT_MS. With `nodes:` in the application file the
 * publisher must be declared there; otherwise it uses one of `pools: {publishers: N}`.
 * RCL_RET_TOPIC_NAME_INVALID for a name that ROS 2 refuses, and without the component `name_substitutions`
 * for one with {node} or {ns}; RCL_RET_UNSUPPORTED for a QoS that XRCE cannot carry, RCL_RET_TIMEOUT,
 * otherwise RCL_RET_ERROR with a text.
 */
rcl_ret_t rcl_publisher_init(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name, const rcl_publisher_options_t * options);

/* Frees the publisher's place at once; waits for the agent, at most MICROROS_CLOSE_TIMEOUT_MS. */
rcl_ret_t rcl_publisher_fini(rcl_publisher_t * publisher, rcl_node_t * node);

/* Returns options with rmw_qos_profile_default. */
rcl_publisher_options_t rcl_publisher_get_default_options(void);

/*
 * Encodes into the stream and runs the session. Does not wait, unless `on_full` is block (then at most
 * MICROROS_ON_FULL_BLOCK_MS). RCL_RET_OK: the stream has accepted the message. RCL_RET_ERROR: a field
 * exceeds the limit of this publisher in the application file, no room, or no session; the text says
 * which, and `dropped` of rmw_uros_get_statistics counts the last two. Of a reliable message larger than
 * MICROROS_MTU at most 16 fragments are sent at once, the others in later calls: rcl_publish,
 * rmw_uros_spin_once, rmw_uros_flush.
 */
rcl_ret_t rcl_publish(
  const rcl_publisher_t * publisher, const void * ros_message, rmw_publisher_allocation_t * allocation);

/* As rcl_publish, for little endian CDR including its four bytes of encapsulation. */
rcl_ret_t rcl_publish_serialized_message(
  const rcl_publisher_t * publisher, const rcl_serialized_message_t * serialized_message,
  rmw_publisher_allocation_t * allocation);

/* Waits until the agent has acknowledged every reliable message that was published before the call, as
 * rmw_uros_flush does; `timeout` is in nanoseconds, negative: no time-out. RCL_RET_TIMEOUT otherwise. */
rcl_ret_t rcl_publisher_wait_for_all_acked(const rcl_publisher_t * publisher, rcl_duration_value_t timeout);

/* Succeeds and sends nothing: liveliness is automatic, the only kind that XRCE supports. */
rcl_ret_t rcl_publisher_assert_liveliness(const rcl_publisher_t * publisher);

/* Returns the fully qualified name, which belongs to the publisher; NULL for an invalid publisher. */
const char * rcl_publisher_get_topic_name(const rcl_publisher_t * publisher);

/*
 * Returns the QoS requested from the agent, with defaults resolved; NULL for an invalid publisher. Belongs
 * to the publisher. */
const rmw_qos_profile_t * rcl_publisher_get_actual_qos(const rcl_publisher_t * publisher);

/* Same as options: the QoS is the actual one, the allocator the default one, since none is called. */
const rcl_publisher_options_t * rcl_publisher_get_options(const rcl_publisher_t * publisher);

rmw_publisher_t * rcl_publisher_get_rmw_handle(const rcl_publisher_t * publisher);

bool rcl_publisher_is_valid(const rcl_publisher_t * publisher);

bool rcl_publisher_is_valid_except_context(const rcl_publisher_t * publisher);

bool rcl_publisher_can_loan_messages(const rcl_publisher_t * publisher);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_PUBLISHER_H */
