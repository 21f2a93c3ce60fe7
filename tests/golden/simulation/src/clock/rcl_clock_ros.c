/* SPDX-License-Identifier: Apache-2.0 */
/* ROS time: the system's, until it is overridden. */
#include "microros/error.h"
#include "microros/rcl_clock.h"
#include "microros/rcl_clock_follow.h"
#include "microros/time_math.h"
#include "microros/rcl_timer.h"
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
  *now = ros_value(data);
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
  clock->data = ros_take(clock);
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
    time->clock = NULL;
    clock->data = NULL;
    clock->type = RCL_CLOCK_UNINITIALIZED;
  }
  return result;
}

static void ros_notify(const rcl_clock_t * clock, const rcl_time_jump_t * jump, bool before_jump)
{
  rcl_timer_on_jump(clock, jump, ros_value(clock->data), before_jump);
  rcl_clock_call_callbacks(clock, jump, before_jump);
}

static rcl_ret_t ros_switch(const rcl_clock_t * clock, bool active)
{
  const rcl_time_jump_t jump = {active ? RCL_ROS_TIME_ACTIVATED : RCL_ROS_TIME_DEACTIVATED, {0}};
  rcl_ret_t result;
  rcl_ros_time_t * time = ros_of(clock, &result);

  if (time != NULL && time->active != active) {
    ros_notify(clock, &jump, true);
    time->active = active;
    ros_notify(clock, &jump, false);
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
    *is_enabled = time->active;
  }
  return result;
}

rcl_ret_t rcl_set_ros_time_override(rcl_clock_t * clock, rcl_time_point_value_t time_value)
{
  rcl_ret_t result;
  rcl_ros_time_t * time = ros_of(clock, &result);

  if (time != NULL && time->active) {
    const rcl_time_jump_t jump = {RCL_ROS_TIME_NO_CHANGE, {microros_time_between(time->now, time_value)}};

    ros_notify(clock, &jump, true);
    time->now = time_value;
    ros_notify(clock, &jump, false);
  } else if (time != NULL) {
    time->now = time_value;
  }
  return result;
}

void rcl_ros_clocks_set(rcl_time_point_value_t time_value)
{
  for (size_t i = 0; i < MICROROS_ROS_CLOCKS_MAX; ++i) {
    if (ros_times[i].clock != NULL) {
      (void)rcl_set_ros_time_override(ros_times[i].clock, time_value); /* cannot fail for a ROS clock */
    }
  }
}
