/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/lock.h"
#include "microros/rcl_diagnosis.h"
#include "microros/rcl_timer_watch.h"
#include "microros/time_math.h"

static const uint32_t ns_per_us = 1000;

static uint32_t timers_overruns; /* calls after the next one was due */
static uint32_t timers_latest_ns;

#if MICROROS_DIAGNOSIS_TIMERS > 0u
static uint32_t timers_each_ns[MICROROS_DIAGNOSIS_TIMERS];

/* Declared timers of one period are told apart by the order in which the program initializes them. */
static void timers_note(const rcl_timer_impl_t * timer, uint32_t late_ns)
{
  uint32_t before = 0;

  for (const rcl_timer_impl_t * other = rcl_timers; other != timer; ++other) {
    before += other->clock != NULL && other->period == timer->period ? 1u : 0u;
  }
  for (uint32_t i = 0; i < MICROROS_DIAGNOSIS_TIMERS; ++i) {
    if (rcl_diagnosis_periods[i] != timer->period) {
      continue;
    }
    if (before == 0u) {
      timers_each_ns[i] = late_ns > timers_each_ns[i] ? late_ns : timers_each_ns[i];
      return;
    }
    --before;
  }
}

uint32_t rcl_diagnosis_timer_us(uint8_t timer)
{
  return timers_each_ns[timer] / ns_per_us;
}
#else
static void timers_note(const rcl_timer_impl_t * timer, uint32_t late_ns)
{
  (void)timer;
  (void)late_ns;
}
#endif

void rcl_timer_watch(const rcl_timer_impl_t * timer, int64_t now)
{
  const int64_t late = microros_time_between(timer->next_call_time, now);
  uint32_t late_ns;

  /* The ROS clock jumps, and the application sets it: that says nothing about this device. */
  if (late <= 0 || timer->clock->type == RCL_ROS_TIME) {
    return;
  }
  late_ns = late > (int64_t)UINT32_MAX ? UINT32_MAX : (uint32_t)late;
  microros_lock();
  if (timer->period != 0 && late >= timer->period) {
    ++timers_overruns;
  }
  if (late_ns > timers_latest_ns) {
    timers_latest_ns = late_ns;
  }
  timers_note(timer, late_ns);
  microros_unlock();
}

uint32_t rcl_diagnosis_overruns(void)
{
  return timers_overruns;
}

uint32_t rcl_diagnosis_latest_us(void)
{
  return timers_latest_ns / ns_per_us;
}
