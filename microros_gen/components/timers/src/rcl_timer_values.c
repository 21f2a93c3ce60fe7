/* SPDX-License-Identifier: Apache-2.0 */
/* Getters and setters of timers. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_timer.h"
#include "microros/time_math.h"

rcl_ret_t rcl_timer_clock(const rcl_timer_t * timer, rcl_clock_t ** clock)
{
  if (timer == NULL || clock == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "timer or clock");
  }
  if (rcl_timer_check(timer) != RCL_RET_OK) {
    return RCL_RET_TIMER_INVALID;
  }
  *clock = timer->impl->clock;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_get_time_since_last_call(const rcl_timer_t * timer, int64_t * time_since_last_call)
{
  rcl_ret_t result = rcl_timer_check(timer);
  rcl_time_point_value_t now;

  if (result != RCL_RET_OK) {
    return result;
  }
  if (time_since_last_call == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "time_since_last_call");
  }
  result = rcl_clock_get_now(timer->impl->clock, &now);
  if (result == RCL_RET_OK) {
    microros_lock();
    *time_since_last_call = microros_time_between(timer->impl->last_call_time, now);
    microros_unlock();
  }
  return result;
}

rcl_ret_t rcl_timer_get_period(const rcl_timer_t * timer, int64_t * period)
{
  const rcl_ret_t result = rcl_timer_check(timer);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (period == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "period");
  }
  microros_lock();
  *period = timer->impl->period;
  microros_unlock();
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_exchange_period(const rcl_timer_t * timer, int64_t new_period, int64_t * old_period)
{
  const rcl_ret_t result = rcl_timer_check(timer);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (old_period == NULL || new_period < 0) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "new_period or old_period");
  }
  microros_lock();
  *old_period = timer->impl->period;
  timer->impl->period = new_period;
  microros_unlock();
  return RCL_RET_OK;
}

rcl_timer_callback_t rcl_timer_get_callback(const rcl_timer_t * timer)
{
  rcl_timer_callback_t callback = NULL;

  if (rcl_timer_check(timer) == RCL_RET_OK) {
    microros_lock();
    callback = timer->impl->callback;
    microros_unlock();
  }
  return callback;
}

rcl_timer_callback_t rcl_timer_exchange_callback(rcl_timer_t * timer, const rcl_timer_callback_t new_callback)
{
  rcl_timer_callback_t old_callback = NULL;

  if (rcl_timer_check(timer) == RCL_RET_OK) {
    microros_lock();
    old_callback = timer->impl->callback;
    timer->impl->callback = new_callback;
    microros_unlock();
  }
  return old_callback;
}

rcl_ret_t rcl_timer_is_canceled(const rcl_timer_t * timer, bool * is_canceled)
{
  const rcl_ret_t result = rcl_timer_check(timer);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (is_canceled == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "is_canceled");
  }
  microros_lock();
  *is_canceled = timer->impl->canceled;
  microros_unlock();
  return RCL_RET_OK;
}

const rcl_allocator_t * rcl_timer_get_allocator(const rcl_timer_t * timer)
{
  static rcl_allocator_t allocator;

  if (rcl_timer_check(timer) != RCL_RET_OK) {
    return NULL;
  }
  allocator = rcl_get_default_allocator();
  return &allocator;
}

rcl_ret_t rcl_timer_set_on_reset_callback(
  const rcl_timer_t * timer, rcl_event_callback_t on_reset_callback, const void * user_data)
{
  const rcl_ret_t result = rcl_timer_check(timer);
  rcl_timer_impl_t * impl;
  size_t resets = 0;

  if (result != RCL_RET_OK) {
    return result;
  }
  impl = timer->impl;
  microros_lock();
  impl->on_reset = on_reset_callback;
  impl->on_reset_data = on_reset_callback != NULL ? user_data : NULL;
  if (on_reset_callback != NULL) {
    resets = impl->resets;
    impl->resets = 0;
  }
  microros_unlock();
  if (resets != 0u) {
    on_reset_callback(user_data, resets);
  }
  return RCL_RET_OK;
}
