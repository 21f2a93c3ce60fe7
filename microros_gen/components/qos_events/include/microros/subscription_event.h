/* SPDX-License-Identifier: Apache-2.0 */
/* Part of rcl/event.h. */
#ifndef MICROROS_SUBSCRIPTION_EVENT_H
#define MICROROS_SUBSCRIPTION_EVENT_H

#include "rcl/event.h"
#include "rcl/subscription.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Begins to observe the subscription: the deadline in its QoS, without which nothing is ever missed; and with the
 * component `graph_events` endpoints that match, or do not because of their QoS. Finalize the event before the
 * subscription. RCL_RET_EVENT_INVALID for NULL; RCL_RET_INVALID_ARGUMENT for an invalid subscription;
 * RCL_RET_ALREADY_INIT, also if the subscription has an event of the type; RCL_RET_UNSUPPORTED, with a text, for
 * other types: XRCE carries no liveliness.
 */
rcl_ret_t rcl_subscription_event_init(
  rcl_event_t * event, const rcl_subscription_t * subscription,
  const rcl_subscription_event_type_t event_type);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_SUBSCRIPTION_EVENT_H */
