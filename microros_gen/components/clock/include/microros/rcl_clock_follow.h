/* SPDX-License-Identifier: Apache-2.0 */
/* ROS time follows no source: it is the system's time until it is overridden. A component that receives
 * the time replaces this header. Internal. */
#ifndef MICROROS_RCL_CLOCK_FOLLOW_H
#define MICROROS_RCL_CLOCK_FOLLOW_H

#include "microros/rcl_clock.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called before each read of the time. */
static inline void rcl_clock_follow(void)
{
}

/* Called when a ROS clock is initialized. */
static inline void rcl_clock_first_time(rcl_ros_time_t * time)
{
  time->active = false;
  time->now = 0;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_FOLLOW_H */
