/* SPDX-License-Identifier: Apache-2.0 */
/* What ROS time follows: nothing, so it is the system's until it is overridden. A component that receives the time brings
 * another file of this name. Internal. */
#ifndef MICROROS_RCL_CLOCK_FOLLOW_H
#define MICROROS_RCL_CLOCK_FOLLOW_H

#include "microros/rcl_clock.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Somebody asks for the time. */
static inline void rcl_clock_follow(void)
{
}

/* A ROS clock begins. */
static inline void rcl_clock_first_time(rcl_ros_time_t * time)
{
  time->active = false;
  time->now = 0;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_FOLLOW_H */
