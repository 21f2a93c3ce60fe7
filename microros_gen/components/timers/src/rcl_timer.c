/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_guard_condition.h"
#include "microros/rcl_timer.h"
#include "microros/rcl_timer_gate.h"
#include "microros/time_math.h"
#include "microros/wake.h"

#include <string.h>

rcl_timer_impl_t rcl_timers[MICROROS_TIMERS_MAX];

rcl_timer_t rcl_get_zero_initialized_timer(void)
{
  const rcl_timer_t timer = {NULL};

  return timer;
}

rcl_ret_t rcl_timer_check(const rcl_timer_t * timer)
{
  if (timer == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "timer");
  }
  if (timer->impl == NULL || timer->impl->clock == NULL) {
    return microros_error_refuse(RCL_RET_TIMER_INVALID, "timer");
  }
  return RCL_RET_OK;
}

static rcl_ret_t timer_begin(
  rcl_timer_impl_t * timer, rcl_clock_t * clock, int64_t period, rcl_timer_callback_t callback,
  bool autostart)
{
  rcl_time_point_value_t now;
  const rcl_ret_t result = rcl_clock_get_now(clock, &now);

  if (result != RCL_RET_OK) {
    return result;
  }
  (void)memset(timer, 0, sizeof(*timer));
  timer->clock = clock;
  timer->callback = callback;
  timer->period = period;
  timer->last_call_time = now;
  timer->next_call_time = microros_time_after(now, period);
  timer->canceled = !autostart;
  rcl_timer_gate_begin(timer);
  if (autostart && !rcl_timer_source_start(timer)) {
    timer->clock = NULL;
    return microros_error_named(RCL_RET_ERROR, microros_error_timer, "the system starts none");
  }
  return RCL_RET_OK;
}

static rcl_ret_t timer_refuse(void)
{
  microros_error_set(
    microros_error_of_pool(microros_error_pool_full, MICROROS_TIMERS_MAX), "timers", NULL,
    MICROROS_TIMERS_MAX, MICROROS_TIMERS_MAX + 1u);
  return RCL_RET_BAD_ALLOC;
}

rcl_ret_t rcl_timer_init2(
  rcl_timer_t * timer, rcl_clock_t * clock, rcl_context_t * context, int64_t period,
  const rcl_timer_callback_t callback, rcl_allocator_t allocator, bool autostart)
{
  rcl_timer_impl_t * place;
  rcl_ret_t result;

  (void)allocator;
  if (timer == NULL || clock == NULL || context == NULL || period < 0) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "timer, clock, context or period");
  }
  if (timer->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_timer, "initialized already");
  }
  if (!rcl_context_is_valid(context)) {
    return microros_error_refuse(RCL_RET_NOT_INIT, "context");
  }
  microros_lock(); /* tasks may initialize timers at the same time */
  microros_lock_silence(true);
  place = rcl_timer_source_take(period);
  result = place != NULL ? timer_begin(place, clock, period, callback, autostart) : timer_refuse();
  microros_lock_silence(false);
  microros_unlock();
  if (result == RCL_RET_OK) {
    timer->impl = place;
  }
  return result;
}

rcl_ret_t rcl_timer_init(
  rcl_timer_t * timer, rcl_clock_t * clock, rcl_context_t * context, int64_t period,
  const rcl_timer_callback_t callback, rcl_allocator_t allocator)
{
  return rcl_timer_init2(timer, clock, context, period, callback, allocator, true);
}

rcl_ret_t rcl_timer_cancel(rcl_timer_t * timer)
{
  const rcl_ret_t result = rcl_timer_check(timer);

  if (result == RCL_RET_OK) {
    microros_lock();
    timer->impl->canceled = true;
    rcl_timer_source_stop(timer->impl);
    microros_unlock();
  }
  return result;
}

rcl_ret_t rcl_timer_fini(rcl_timer_t * timer)
{
  if (timer != NULL && timer->impl != NULL) {
    microros_lock();
    rcl_timer_source_stop(timer->impl);
    if (timer->impl->guard != NULL) {
      timer->impl->guard->taken = false;
    }
    timer->impl->clock = NULL;
    microros_unlock();
    timer->impl = NULL;
  }
  return RCL_RET_OK;
}

void rcl_timer_wake(rcl_timer_impl_t * timer)
{
  timer->woken = true;
  if (timer->guard != NULL) {
    microros_flag_set(&timer->guard->is_triggered);
  }
  microros_wake();
}

/* Returns whether the timer runs. */
static bool timer_restart(rcl_timer_impl_t * timer, rcl_time_point_value_t now)
{
  rcl_timer_source_stop(timer);
  timer->next_call_time = microros_time_after(now, timer->period);
  timer->canceled = !rcl_timer_source_start(timer);
  if (timer->canceled) {
    return false;
  }
  rcl_timer_wake(timer); /* the waiting task must consider the new due time */
  return true;
}

rcl_ret_t rcl_timer_reset(rcl_timer_t * timer)
{
  rcl_ret_t result = rcl_timer_check(timer);
  rcl_time_point_value_t now = 0;
  rcl_timer_impl_t * impl;
  rcl_event_callback_t on_reset;
  const void * user_data;
  bool runs;

  if (result == RCL_RET_OK) {
    result = rcl_clock_get_now(timer->impl->clock, &now);
  }
  if (result != RCL_RET_OK) {
    return result;
  }
  impl = timer->impl;
  microros_lock();
  runs = timer_restart(impl, now);
  on_reset = impl->on_reset;
  user_data = impl->on_reset_data;
  if (runs && on_reset == NULL) {
    ++impl->resets;
  }
  microros_unlock();
  if (!runs) {
    return microros_error_named(RCL_RET_ERROR, microros_error_timer, "the system starts none");
  }
  if (on_reset != NULL) {
    on_reset(user_data, 1);
  }
  return RCL_RET_OK;
}
