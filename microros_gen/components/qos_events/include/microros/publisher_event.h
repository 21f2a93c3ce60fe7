/* SPDX-License-Identifier: Apache-2.0 */
/* Part of rcl/event.h. */
#ifndef MICROROS_PUBLISHER_EVENT_H
#define MICROROS_PUBLISHER_EVENT_H

#include "rcl/event.h"
#include "rcl/publisher.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Begins to observe the deadline in the QoS of the publisher; without a deadline nothing is ever missed.
 * Finalize the event before the publisher. RCL_RET_EVENT_INVALID for NULL; RCL_RET_INVALID_ARGUMENT for an
 * invalid publisher; RCL_RET_ALREADY_INIT, also if the publisher has an event; RCL_RET_UNSUPPORTED, with a
 * text, for other types: XRCE carries no liveliness and reports neither matched nor incompatible endpoints.
 * rcl_publisher_get_subscription_count of component graph counts matched ones.
 */
rcl_ret_t rcl_publisher_event_init(
  rcl_event_t * event, const rcl_publisher_t * publisher, const rcl_publisher_event_type_t event_type);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PUBLISHER_EVENT_H */
