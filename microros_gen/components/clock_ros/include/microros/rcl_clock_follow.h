/* SPDX-License-Identifier: Apache-2.0 */
/* What ROS time follows: /clock. In place of the file of the clock. Internal. */
#ifndef MICROROS_RCL_CLOCK_FOLLOW_H
#define MICROROS_RCL_CLOCK_FOLLOW_H

#include "microros/rcl_clock.h"
#include "microros/rcl_clock_source.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Somebody asks for the time. */
static inline void rcl_clock_follow(void)
{
  rcl_clock_source_follow();
}

/* A ROS clock begins. */
static inline void rcl_clock_first_time(rcl_ros_time_t * time)
{
  time->active = true;
  time->now = rcl_clock_source_time();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_FOLLOW_H */
