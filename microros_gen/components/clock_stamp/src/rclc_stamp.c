/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/stamp.h"

#include "microros/error.h"
#include "microros/rcl_clock.h"
#include "microros/rcl_clock_epoch.h"

#include <stdbool.h>
#include <stddef.h>

enum { STAMP_NS_PER_S = 1000000000 };

/* Returns whether the clock has the time of day or that of /clock; others begin with the device. */
static bool stamp_is_known(rcl_clock_t * clock)
{
  bool is_simulated = false;

  if (clock->type == RCL_ROS_TIME) {
    (void)rcl_is_enabled_ros_time_override(clock, &is_simulated); /* cannot fail for a ROS clock */
  }
  return is_simulated || (clock->type != RCL_STEADY_TIME && rcl_clock_epoch_ns() != 0);
}

rcl_ret_t rclc_stamp(rcl_clock_t * clock, int32_t * sec, uint32_t * nanosec)
{
  rcl_time_point_value_t now = 0;
  bool is_known;
  rcl_ret_t result;
  int64_t whole_s;
  int64_t rest_ns;

  if (sec == NULL || nanosec == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "sec or nanosec");
  }
  is_known = clock != NULL && stamp_is_known(clock); /* first: another task may set the epoch in between */
  result = rcl_clock_get_now(clock, &now);
  if (result != RCL_RET_OK) {
    return result;
  }
  whole_s = now / STAMP_NS_PER_S;
  rest_ns = now % STAMP_NS_PER_S;
  if (now <= 0 || !is_known) {
    return rcl_clock_refuse(RCL_RET_ERROR, MICROROS_ERROR_WORDS("it has no time for a stamp yet"));
  }
  if (whole_s > INT32_MAX) {
    return rcl_clock_refuse(RCL_RET_ERROR, MICROROS_ERROR_WORDS("a stamp ends in the year 2038"));
  }
  *sec = (int32_t)whole_s;
  *nanosec = (uint32_t)rest_ns;
  return RCL_RET_OK;
}
