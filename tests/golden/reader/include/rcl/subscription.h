/* SPDX-License-Identifier: Apache-2.0 */
/* Subscriptions. */
#ifndef MICROROS_RCL_SUBSCRIPTION_H
#define MICROROS_RCL_SUBSCRIPTION_H

#include <stdbool.h>
#include <stddef.h>

#include "rcl/macros.h"
#include "rcl/node.h"
#include "rcl/visibility_control.h"
#include "rmw/qos_profiles.h"
#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_subscription_s rcl_subscription_impl_t;

typedef struct rcl_subscription_s {
  rcl_subscription_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_subscription_t;

typedef struct rcl_subscription_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
  rmw_subscription_options_t rmw_subscription_options;
  bool disable_loaned_message;
} rcl_subscription_options_t;

rcl_subscription_t rcl_get_zero_initialized_subscription(void);

/*
 * Waits for the agent, at most MICROROS_CREATE_TIMEOUT_MS. With `nodes:` in the application file the
 * subscription must be declared there; otherwise it uses one of `pools: {subscriptions: N}`. From then on
 * any function of the library receives samples into the queue, up to `queue:`; a subscription continues
 * automatically after a lost session. RCL_RET_TOPIC_NAME_INVALID as for rcl_publisher_init,
 * RCL_RET_UNSUPPORTED for a QoS that XRCE cannot carry, RCL_RET_TIMEOUT, otherwise RCL_RET_ERROR with a
 * text.
 */
rcl_ret_t rcl_subscription_init(
  rcl_subscription_t * subscription, const rcl_node_t * node,
  const rosidl_message_type_support_t * type_support, const char * topic_name,
  const rcl_subscription_options_t * options);

/* Frees the subscription's place and its queue at once; waits for the agent, at most
 * MICROROS_CLOSE_TIMEOUT_MS. */
rcl_ret_t rcl_subscription_fini(rcl_subscription_t * subscription, rcl_node_t * node);

/* Returns options with rmw_qos_profile_default. */
rcl_subscription_options_t rcl_subscription_get_default_options(void);

rcl_ret_t rcl_subscription_options_fini(rcl_subscription_options_t * option);

/*
 * Receives without waiting, and decodes the oldest sample into the storage of the message: strings and
 * sequences need `data` and `capacity`. `message_info` may be NULL; `allocation` is not used.
 * RCL_RET_SUBSCRIPTION_TAKE_FAILED: no sample was received. RCL_RET_ERROR, with a text: a sample was
 * discarded because it exceeds the subscription's limits or a capacity of the message, or is not of its
 * type; or the agent refuses to read. The next call returns the next sample.
 */
rcl_ret_t rcl_take(
  const rcl_subscription_t * subscription, void * ros_message, rmw_message_info_t * message_info,
  rmw_subscription_allocation_t * allocation);

/* As rcl_take, but returns the bytes, including four bytes of encapsulation. A buffer that is too small is
 * resized by its allocator; otherwise RCL_RET_BAD_ALLOC, and the sample stays. */
rcl_ret_t rcl_take_serialized_message(
  const rcl_subscription_t * subscription, rcl_serialized_message_t * serialized_message,
  rmw_message_info_t * message_info, rmw_subscription_allocation_t * allocation);

/* Returns the fully qualified name, which belongs to the subscription; NULL for an invalid subscription. */
const char * rcl_subscription_get_topic_name(const rcl_subscription_t * subscription);

/*
 * Returns the QoS requested from the agent, with defaults resolved; NULL for an invalid subscription.
 * Belongs to the subscription. */
const rmw_qos_profile_t * rcl_subscription_get_actual_qos(const rcl_subscription_t * subscription);

/* Same as options: the QoS is the actual one, the allocator the default one, since none is called. */
const rcl_subscription_options_t * rcl_subscription_get_options(const rcl_subscription_t * subscription);

rmw_subscription_t * rcl_subscription_get_rmw_handle(const rcl_subscription_t * subscription);

bool rcl_subscription_is_valid(const rcl_subscription_t * subscription);

bool rcl_subscription_is_cft_enabled(const rcl_subscription_t * subscription);

bool rcl_subscription_can_loan_messages(const rcl_subscription_t * subscription);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_SUBSCRIPTION_H */
