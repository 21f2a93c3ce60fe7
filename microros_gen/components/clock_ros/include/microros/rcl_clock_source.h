/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Where ROS time comes from: a subscription of /clock that the library opens with a node and that the application never
 * sees. Its queue has one place, so the newest time counts. Internal; belongs to the task of the clocks.
 */
#ifndef MICROROS_RCL_CLOCK_SOURCE_H
#define MICROROS_RCL_CLOCK_SOURCE_H

#include "rcl/node.h"
#include "rcl/time.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A node was opened: the first one, or the first of the application file, gets the subscription. Waits for the agent, and
 * gives codes, as rcl_subscription_init. */
rcl_ret_t rcl_clock_source_open(const rcl_node_t * node);

/* This node is about to be closed; if it has the subscription, time stands still until a node is opened again. */
void rcl_clock_source_close(const rcl_node_t * node);

/* Sets every ROS clock to the time that has come since the last call, without receiving. Does nothing while it is called
 * by a jump callback. */
void rcl_clock_source_follow(void);

/* Returns the time that came last; 0: none has come. */
rcl_time_point_value_t rcl_clock_source_time(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_SOURCE_H */
