/* SPDX-License-Identifier: Apache-2.0 */
/* ROS time follows /clock. Replaces the header of component `clock`. Internal. */
#ifndef MICROROS_RCL_CLOCK_FOLLOW_H
#define MICROROS_RCL_CLOCK_FOLLOW_H

#include "microros/rcl_clock.h"
#include "microros/rcl_clock_source.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called before each read of the time. */
static inline void rcl_clock_follow(void)
{
  rcl_clock_source_follow();
}

/* Called when a ROS clock is initialized. */
static inline void rcl_clock_first_time(rcl_ros_time_t * time)
{
  time->active = true;
  time->now = rcl_clock_source_time();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_FOLLOW_H */
