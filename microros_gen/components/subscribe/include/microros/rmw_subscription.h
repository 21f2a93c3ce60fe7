/* SPDX-License-Identifier: Apache-2.0 */
/* Subscriptions of the middleware layer. Internal. */
#ifndef MICROROS_RMW_SUBSCRIPTION_H
#define MICROROS_RMW_SUBSCRIPTION_H

#include <stdbool.h>

#include "microros/xrce_objects.h"
#include "rmw/types.h"
#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Takes a place for a subscription and waits for its objects. RMW_RET_OK: *subscription is set and belongs
 * to the library; otherwise RMW_RET_UNSUPPORTED, RMW_RET_TIMEOUT or RMW_RET_ERROR with a text. `topic` is
 * valid and not expanded.
 */
rmw_ret_t rmw_subscription_open(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, const char * topic,
  const rmw_qos_profile_t * qos, rmw_subscription_t ** subscription);

/* Same for the subscription to /clock, which has a reserved place; with the component `clock_ros`. */
rmw_ret_t rmw_subscription_open_clock(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, const char * topic,
  const rmw_qos_profile_t * qos, rmw_subscription_t ** subscription);

/* Releases the place. */
void rmw_subscription_close(rmw_subscription_t * subscription);

bool rmw_subscription_is_open(const rmw_subscription_t * subscription);

/*
 * --- for an open subscription, without receiving: a caller that waits for several has already received
 * --- */

/* Returns whether rmw_subscription_take has a sample or an error to report. */
bool rmw_subscription_is_ready(const rmw_subscription_t * subscription);

/* Describes the oldest sample before it is taken; all zero if the queue is empty. */
void rmw_subscription_describe(const rmw_subscription_t * subscription, rmw_message_info_t * info);

/* Decodes the oldest sample; *taken is false if the queue is empty, and on error. */
rmw_ret_t rmw_subscription_take(const rmw_subscription_t * subscription, void * ros_message, bool * taken);

/* Same, but returns the bytes. */
rmw_ret_t rmw_subscription_take_serialized(
  const rmw_subscription_t * subscription, rmw_serialized_message_t * serialized_message, bool * taken);

/* Receives without waiting. */
void rmw_subscription_pump(const rmw_subscription_t * subscription);

/*
 * Binds a message without any buffer for strings and sequences to the storage of the subscription's
 * declaration. A message with buffers stays unchanged, as does one of a subscription without a
 * declaration.
 */
void rmw_subscription_bind(const rmw_subscription_t * subscription, void * ros_message);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_SUBSCRIPTION_H */
