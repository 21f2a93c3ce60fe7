/* SPDX-License-Identifier: Apache-2.0 */
/* ROS time: the system's, until it is overridden. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_clock.h"
#include "microros/rcl_clock_follow.h"
#include "microros/time_math.h"
#include "microros_config.h"

#include <stddef.h>

static rcl_ros_time_t ros_times[MICROROS_ROS_CLOCKS_MAX];

static rcl_time_point_value_t ros_value(const rcl_ros_time_t * time)
{
  rcl_time_point_value_t now = time->now;

  if (!time->active) {
    (void)rcl_clock_system_now(NULL, &now); /* the system clock cannot fail */
  }
  return now;
}

static rcl_ret_t ros_now(void * data, rcl_time_point_value_t * now)
{
  rcl_clock_follow();
  microros_lock();
  *now = ros_value(data);
  microros_unlock();
  return RCL_RET_OK;
}

/* Returns the place of this clock; NULL: it has no place. */
static rcl_ros_time_t * ros_find(const rcl_clock_t * clock)
{
  for (size_t i = 0; i < MICROROS_ROS_CLOCKS_MAX; ++i) {
    if (ros_times[i].clock == clock) {
      return &ros_times[i];
    }
  }
  return NULL;
}

/* A clock that is initialized again keeps its place. */
static rcl_ros_time_t * ros_take(rcl_clock_t * clock)
{
  rcl_ros_time_t * time = ros_find(clock);

  if (time == NULL) {
    time = ros_find(NULL);
  }
  if (time == NULL) {
    microros_error_set(
      microros_error_of_pool(microros_error_pool_full, MICROROS_ROS_CLOCKS_MAX), "ros_clocks", NULL,
      MICROROS_ROS_CLOCKS_MAX, MICROROS_ROS_CLOCKS_MAX + 1u);
    return NULL;
  }
  time->clock = clock;
  rcl_clock_first_time(time);
  return time;
}

rcl_ret_t rcl_ros_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator)
{
  const rcl_ret_t result = rcl_clock_begin(clock, RCL_CLOCK_UNINITIALIZED, ros_now, allocator);

  if (result != RCL_RET_OK) {
    return result;
  }
  microros_lock();
  clock->data = ros_take(clock);
  microros_unlock();
  if (clock->data == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  clock->type = RCL_ROS_TIME;
  return RCL_RET_OK;
}

/* Returns the state of a ROS clock; NULL, with *result and the text set, for any other clock. */
static rcl_ros_time_t * ros_of(const rcl_clock_t * clock, rcl_ret_t * result)
{
  *result = RCL_RET_OK;
  if (clock == NULL) {
    *result = microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "clock");
    return NULL;
  }
  if (clock->type != RCL_ROS_TIME || clock->data == NULL) {
    *result = rcl_clock_refuse(RCL_RET_ERROR, "not of the type RCL_ROS_TIME");
    return NULL;
  }
  return clock->data;
}

rcl_ret_t rcl_ros_clock_fini(rcl_clock_t * clock)
{
  rcl_ret_t result;
  rcl_ros_time_t * time = ros_of(clock, &result);

  if (time != NULL) {
    result = rcl_clock_end(clock, RCL_ROS_TIME);
    microros_lock();
    time->clock = NULL;
    time->active = false;
    microros_unlock();
    clock->data = NULL;
    clock->type = RCL_CLOCK_UNINITIALIZED;
  }
  return result;
}

/* `time` is that of the clock, which the hooks use with the lock; the callbacks are called without it. */
static void ros_notify(
  const rcl_ros_time_t * time, const rcl_clock_t * clock, const rcl_time_jump_t * jump, bool before_jump)
{
  (void)time; /* without hooks */
  microros_lock();
  microros_unlock();
  rcl_clock_call_callbacks(clock, jump, before_jump);
}

static bool ros_is_active(const rcl_ros_time_t * time)
{
  bool is_active;

  microros_lock();
  is_active = time->active;
  microros_unlock();
  return is_active;
}

static rcl_ret_t ros_switch(const rcl_clock_t * clock, bool active)
{
  const rcl_time_jump_t jump = {active ? RCL_ROS_TIME_ACTIVATED : RCL_ROS_TIME_DEACTIVATED, {0}};
  rcl_ret_t result;
  rcl_ros_time_t * time = ros_of(clock, &result);

  if (time != NULL && ros_is_active(time) != active) {
    ros_notify(time, clock, &jump, true);
    microros_lock();
    time->active = active;
    microros_unlock();
    ros_notify(time, clock, &jump, false);
  }
  return result;
}

rcl_ret_t rcl_enable_ros_time_override(rcl_clock_t * clock)
{
  return ros_switch(clock, true);
}

rcl_ret_t rcl_disable_ros_time_override(rcl_clock_t * clock)
{
  return ros_switch(clock, false);
}

rcl_ret_t rcl_is_enabled_ros_time_override(rcl_clock_t * clock, bool * is_enabled)
{
  rcl_ret_t result;
  const rcl_ros_time_t * time = ros_of(clock, &result);

  if (time != NULL && is_enabled == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "is_enabled");
  }
  if (time != NULL) {
    *is_enabled = ros_is_active(time);
  }
  return result;
}

/* A free place is not active. */
static void ros_set(rcl_ros_time_t * time, rcl_time_point_value_t value)
{
  const rcl_clock_t * clock;
  rcl_time_jump_t jump = {RCL_ROS_TIME_NO_CHANGE, {0}};
  bool is_active;

  microros_lock();
  clock = time->clock;
  is_active = time->active;
  if (is_active) {
    jump.delta.nanoseconds = microros_time_between(time->now, value);
  } else {
    time->now = value;
  }
  microros_unlock();
  if (is_active) {
    ros_notify(time, clock, &jump, true);
    microros_lock();
    time->now = value;
    microros_unlock();
    ros_notify(time, clock, &jump, false);
  }
}

rcl_ret_t rcl_set_ros_time_override(rcl_clock_t * clock, rcl_time_point_value_t time_value)
{
  rcl_ret_t result;
  rcl_ros_time_t * time = ros_of(clock, &result);

  if (time != NULL) {
    ros_set(time, time_value);
  }
  return result;
}

void rcl_ros_clocks_set(rcl_time_point_value_t time_value)
{
  for (size_t i = 0; i < MICROROS_ROS_CLOCKS_MAX; ++i) {
    ros_set(&ros_times[i], time_value);
  }
}
