/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Source of ROS time: a subscription to /clock that the library opens with a node and hides from the
 * application. Its queue has one place, so that the newest time is used. Internal.
 */
#ifndef MICROROS_RCL_CLOCK_SOURCE_H
#define MICROROS_RCL_CLOCK_SOURCE_H

#include "rcl/node.h"
#include "rcl/time.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new node: the first node of the application file, or the first one opened, gets the
 * subscription. Waits for the agent and returns the same codes as rcl_subscription_init. */
rcl_ret_t rcl_clock_source_open(const rcl_node_t * node);

/*
 * Called before a node is closed. If it has the subscription, time stands still until a node is opened
 * again. */
void rcl_clock_source_close(const rcl_node_t * node);

/* Sets every ROS clock to the newest received time, without receiving. Does nothing when called from a
 * jump callback, or while another task sets them. Called without the lock: it calls jump callbacks. */
void rcl_clock_source_follow(void);

/* Returns the newest received time; 0: no sample was received. Called with the lock. */
rcl_time_point_value_t rcl_clock_source_time(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_SOURCE_H */
