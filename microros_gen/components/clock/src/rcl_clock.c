/* SPDX-License-Identifier: Apache-2.0 */
/* Clocks: what all have in common, and those of steady and of system time. */
#include "microros/error.h"
#include "microros/port.h"
#include "microros/rcl_clock.h"
#include "microros/rcl_clock_epoch.h"
#include "microros/time_math.h"

#include <string.h>

rcl_ret_t rcl_clock_refuse(rcl_ret_t result, const char * reason)
{
  return microros_error_named(result, microros_error_clock, reason);
}

rcl_ret_t rcl_clock_begin(
  rcl_clock_t * clock, rcl_clock_type_t type, rcl_clock_get_now_t get_now, const rcl_allocator_t * allocator)
{
  if (clock == NULL || allocator == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "clock or allocator");
  }
  (void)memset(clock, 0, sizeof(*clock));
  clock->type = type;
  clock->get_now = get_now;
  clock->allocator = *allocator;
  return RCL_RET_OK;
}

rcl_ret_t rcl_clock_end(rcl_clock_t * clock, rcl_clock_type_t type)
{
  if (clock == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "clock");
  }
  if (clock->type != type) {
    return rcl_clock_refuse(RCL_RET_ERROR, "of another type");
  }
  if (clock->num_jump_callbacks != 0u) {
    rcl_clock_remove_callbacks(clock);
  }
  return RCL_RET_OK;
}

bool rcl_clock_valid(rcl_clock_t * clock)
{
  return clock != NULL && clock->type != RCL_CLOCK_UNINITIALIZED && clock->get_now != NULL;
}

rcl_ret_t rcl_clock_get_now(rcl_clock_t * clock, rcl_time_point_value_t * time_point_value)
{
  if (clock == NULL || time_point_value == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "clock or time_point_value");
  }
  if (!rcl_clock_valid(clock)) {
    return rcl_clock_refuse(RCL_RET_ERROR, "not initialized");
  }
  return clock->get_now(clock->data, time_point_value);
}

bool rcl_clock_time_started(rcl_clock_t * clock)
{
  rcl_time_point_value_t now = 0;

  return rcl_clock_get_now(clock, &now) == RCL_RET_OK && now > 0;
}

rcl_ret_t rcl_clock_init(rcl_clock_type_t clock_type, rcl_clock_t * clock, rcl_allocator_t * allocator)
{
  switch (clock_type) {
    case RCL_CLOCK_UNINITIALIZED:
      return rcl_clock_begin(clock, clock_type, NULL, allocator);
    case RCL_ROS_TIME:
      return rcl_ros_clock_init(clock, allocator);
    case RCL_SYSTEM_TIME:
      return rcl_system_clock_init(clock, allocator);
    case RCL_STEADY_TIME:
      return rcl_steady_clock_init(clock, allocator);
    default:
      return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "clock_type");
  }
}

rcl_ret_t rcl_clock_fini(rcl_clock_t * clock)
{
  if (clock == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "clock");
  }
  switch (clock->type) {
    case RCL_ROS_TIME:
      return rcl_ros_clock_fini(clock);
    case RCL_SYSTEM_TIME:
      return rcl_system_clock_fini(clock);
    case RCL_STEADY_TIME:
      return rcl_steady_clock_fini(clock);
    case RCL_CLOCK_UNINITIALIZED:
    default:
      return rcl_clock_refuse(RCL_RET_INVALID_ARGUMENT, "not initialized");
  }
}

rcl_ret_t rcl_difference_times(
  const rcl_time_point_t * start, const rcl_time_point_t * finish, rcl_duration_t * delta)
{
  if (start == NULL || finish == NULL || delta == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "start, finish or delta");
  }
  if (start->clock_type != finish->clock_type) {
    return rcl_clock_refuse(RCL_RET_ERROR, "the two times are of clocks of different types");
  }
  delta->nanoseconds = microros_time_between(start->nanoseconds, finish->nanoseconds);
  return RCL_RET_OK;
}

static rcl_ret_t clock_steady_now(void * data, rcl_time_point_value_t * now)
{
  (void)data;
  *now = port_time_steady_ns();
  return RCL_RET_OK;
}

rcl_ret_t rcl_steady_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator)
{
  return rcl_clock_begin(clock, RCL_STEADY_TIME, clock_steady_now, allocator);
}

rcl_ret_t rcl_steady_clock_fini(rcl_clock_t * clock)
{
  return rcl_clock_end(clock, RCL_STEADY_TIME);
}

rcl_ret_t rcl_clock_system_now(void * data, rcl_time_point_value_t * now)
{
  const int64_t epoch_ns = rcl_clock_epoch_ns();

  (void)data;
  *now = epoch_ns != 0 ? epoch_ns : port_time_steady_ns(); /* 0: the time of day has not been set yet */
  return RCL_RET_OK;
}

rcl_ret_t rcl_system_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator)
{
  return rcl_clock_begin(clock, RCL_SYSTEM_TIME, rcl_clock_system_now, allocator);
}

rcl_ret_t rcl_system_clock_fini(rcl_clock_t * clock)
{
  return rcl_clock_end(clock, RCL_SYSTEM_TIME);
}
