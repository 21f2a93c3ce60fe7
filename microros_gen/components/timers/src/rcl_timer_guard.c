/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The guard condition of a timer, for waiting on it instead of on the timer; only linked if it is
 * requested. */
#include "microros/lock.h"
#include "microros/rcl_guard_condition.h"
#include "microros/rcl_timer.h"

rcl_guard_condition_t * rcl_timer_get_guard_condition(const rcl_timer_t * timer)
{
  static rcl_guard_condition_impl_t states[MICROROS_TIMERS_MAX];
  static rcl_guard_condition_t guards[MICROROS_TIMERS_MAX];
  rcl_timer_impl_t * impl = timer != NULL ? timer->impl : NULL;
  size_t index;

  if (impl == NULL || impl->clock == NULL) {
    return NULL;
  }
  index = (size_t)(impl - rcl_timers);
  microros_lock();
  if (impl->guard == NULL) {
    impl->guard = &states[index];
    impl->guard->taken = true;
    if (impl->woken) { /* before it was requested */
      microros_flag_set(&impl->guard->is_triggered);
    } else {
      microros_flag_clear(&impl->guard->is_triggered);
    }
    guards[index].impl = impl->guard;
  }
  microros_unlock();
  return &guards[index];
}
