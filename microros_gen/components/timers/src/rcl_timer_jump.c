/* SPDX-License-Identifier: Apache-2.0 */
/* Timers on a clock whose time jumps; only linked with a ROS clock. */
#include "microros/rcl_timer.h"
#include "microros/time_math.h"
#include "microros/wake.h"

static bool jump_changes_time(const rcl_time_jump_t * jump)
{
  return jump->clock_change == RCL_ROS_TIME_ACTIVATED || jump->clock_change == RCL_ROS_TIME_DEACTIVATED;
}

/*
 * As in Jazzy's rcl: the elapsed part of the period in the new time is what remained in the old one. A
 * time of 0 is unset and is ignored.
 */
static void jump_keep_elapsed(size_t index, int64_t now, bool before_jump)
{
  static int64_t credits[MICROROS_TIMERS_MAX]; /* remaining time until the next call */
  rcl_timer_impl_t * timer = &rcl_timers[index];
  int64_t * credit = &credits[index];

  if (before_jump) {
    *credit = now != 0 ? microros_time_between(now, timer->next_call_time) : 0;
  } else if (now != 0 && *credit != 0) {
    timer->last_call_time = microros_time_between(*credit, now);
    timer->next_call_time = microros_time_after(timer->last_call_time, timer->period);
  }
}

/* A due timer wakes the waiting task; after a jump back before the last call the period restarts. */
static void jump_settle(rcl_timer_impl_t * timer, int64_t now)
{
  if (timer->next_call_time <= now) {
    rcl_timer_wake(timer);
  } else if (now < timer->last_call_time) {
    timer->next_call_time = microros_time_after(now, timer->period);
    timer->last_call_time = now;
  }
}

void rcl_timer_on_jump(
  const rcl_clock_t * clock, const rcl_time_jump_t * jump, rcl_time_point_value_t now, bool before_jump)
{
  const bool changes_time = jump_changes_time(jump);

  for (size_t i = 0; i < MICROROS_TIMERS_MAX; ++i) {
    rcl_timer_impl_t * timer = &rcl_timers[i];

    if (timer->clock == clock && changes_time) {
      jump_keep_elapsed(i, now, before_jump);
    } else if (timer->clock == clock && !before_jump) {
      jump_settle(timer, now);
    } else {
      /* another clock, or nothing to do before the jump */
    }
  }
  if (!before_jump) {
    microros_wake(); /* the waiting task must look again */
  }
}
