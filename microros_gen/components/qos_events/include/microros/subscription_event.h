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
 * Begins to observe the deadline in the QoS of the subscription; without a deadline nothing is ever missed.
 * Finalize the event before the subscription. RCL_RET_EVENT_INVALID for NULL; RCL_RET_INVALID_ARGUMENT for an
 * invalid subscription; RCL_RET_ALREADY_INIT, also if the subscription has an event; RCL_RET_UNSUPPORTED, with a
 * text, for other types: XRCE carries no liveliness and reports neither matched nor incompatible endpoints.
 * rcl_subscription_get_publisher_count of component graph counts matched ones.
 */
rcl_ret_t rcl_subscription_event_init(
  rcl_event_t * event, const rcl_subscription_t * subscription,
  const rcl_subscription_event_type_t event_type);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_SUBSCRIPTION_EVENT_H */
