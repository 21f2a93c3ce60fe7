/* SPDX-License-Identifier: Apache-2.0 */
/* No timer has a `kind`: all depend on their clocks. */
#include "microros/rcl_timer.h"

rcl_timer_impl_t * rcl_timer_source_take(int64_t period)
{
  (void)period;
  for (size_t i = 0; i < MICROROS_TIMERS_MAX; ++i) {
    if (rcl_timers[i].clock == NULL) {
      return &rcl_timers[i];
    }
  }
  return NULL;
}

bool rcl_timer_source_start(const rcl_timer_impl_t * timer)
{
  (void)timer;
  return true;
}

void rcl_timer_source_stop(const rcl_timer_impl_t * timer)
{
  (void)timer;
}

void rcl_timer_source_called(const rcl_timer_impl_t * timer)
{
  (void)timer;
}

bool rcl_timer_source_ticks(const rcl_timer_impl_t * timer, bool * is_ready)
{
  (void)timer;
  (void)is_ready;
  return false;
}
