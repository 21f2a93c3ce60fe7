/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_clock.h"
#include "microros/rcl_timer.h"
#include "microros/rcl_timer_gate.h"
#include "microros/rcl_timer_watch.h"
#include "microros/time_math.h"

/*
 * Returns when the next call is due after one that was due at `due`, skipping missed periods. Takes away from the time that
 * is left what fits, the period times the largest power of two first; so even years take some hundred steps, and no 64-bit
 * division is linked.
 */
static int64_t call_next(int64_t due, int64_t period, int64_t now)
{
  const int64_t next = microros_time_after(due, period);
  uint64_t step = (uint64_t)period;
  uint64_t left = 0;

  if (period == 0 || next > now) {
    return next > now ? next : now;
  }
  left = (uint64_t)now - (uint64_t)next; /* exact: below 2^64 */
  /* at most 63 rounds */
  while (step <= left / 2u) {
    step += step;
  }
  while (step >= (uint64_t)period) { /* at most 64 rounds */
    left -= step <= left ? step : 0u;
    step /= 2u;
  }
  return microros_time_after((int64_t)((uint64_t)now - left), period);
}

static bool call_is_canceled(const rcl_timer_impl_t * timer)
{
  bool is_canceled;

  microros_lock();
  is_canceled = timer->canceled;
  microros_unlock();
  return is_canceled;
}

static rcl_ret_t call_now(rcl_timer_t * timer, rcl_timer_call_info_t * call_info)
{
  rcl_timer_impl_t * impl = timer->impl;
  rcl_timer_callback_t callback;
  int64_t since_last_call;
  rcl_time_point_value_t now;
  const rcl_ret_t result = rcl_clock_get_now(impl->clock, &now);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (now < 0) {
    return microros_error_named(RCL_RET_ERROR, microros_error_timer, "the time of its clock is negative");
  }
  microros_lock(); /* other tasks may reset the timer, or set its clock */
  since_last_call = microros_time_between(impl->last_call_time, now);
  call_info->expected_call_time = impl->next_call_time;
  call_info->actual_call_time = now;
  rcl_timer_watch(impl, now);
  impl->last_call_time = now;
  impl->next_call_time = call_next(impl->next_call_time, impl->period, now);
  rcl_timer_source_called(impl);
  callback = impl->callback;
  microros_unlock();
  if (callback != NULL) {
    callback(timer, since_last_call);
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_call_with_info(rcl_timer_t * timer, rcl_timer_call_info_t * call_info)
{
  const rcl_ret_t result = rcl_timer_check(timer);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (call_info == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "call_info");
  }
  if (call_is_canceled(timer->impl)) {
    return microros_error_named(RCL_RET_TIMER_CANCELED, microros_error_timer, "canceled");
  }
  return call_now(timer, call_info);
}

rcl_ret_t rcl_timer_call(rcl_timer_t * timer)
{
  rcl_timer_call_info_t info;

  return rcl_timer_call_with_info(timer, &info);
}

rcl_ret_t rcl_timer_get_time_until_next_call(const rcl_timer_t * timer, int64_t * time_until_next_call)
{
  rcl_ret_t result = rcl_timer_check(timer);
  rcl_time_point_value_t now;

  if (result != RCL_RET_OK) {
    return result;
  }
  if (time_until_next_call == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "time_until_next_call");
  }
  if (call_is_canceled(timer->impl)) {
    return RCL_RET_TIMER_CANCELED;
  }
  result = rcl_clock_get_now(timer->impl->clock, &now);
  if (result == RCL_RET_OK) {
    microros_lock();
    *time_until_next_call = microros_time_between(now, timer->impl->next_call_time);
    microros_unlock();
  }
  return result;
}

/* Returns whether the clock only changes when the application sets it. */
static bool look_is_set_by_hand(const rcl_clock_t * clock)
{
  const rcl_ros_time_t * time = clock->data;

  return clock->type == RCL_ROS_TIME && time->active;
}

rcl_ret_t rcl_timer_look(const rcl_timer_t * timer, bool * is_ready, int64_t * look_again_ns)
{
  int64_t until = 0;
  rcl_ret_t result;

  *is_ready = false;
  *look_again_ns = INT64_MAX;
  result = rcl_timer_get_time_until_next_call(timer, &until);
  if (result == RCL_RET_TIMER_CANCELED) {
    return RCL_RET_OK;
  }
  if (result != RCL_RET_OK) {
    return result;
  }
  microros_lock();
  if (rcl_timer_gate_is_open(timer->impl) && !rcl_timer_source_ticks(timer->impl, is_ready)) {
    *is_ready = until <= 0;
    if (!*is_ready && !look_is_set_by_hand(timer->impl->clock)) {
      *look_again_ns = until;
    }
  }
  microros_unlock();
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_is_ready(const rcl_timer_t * timer, bool * is_ready)
{
  const rcl_ret_t result = rcl_timer_check(timer);
  int64_t look_again_ns;

  if (result != RCL_RET_OK) {
    return result;
  }
  if (is_ready == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "is_ready");
  }
  return rcl_timer_look(timer, is_ready, &look_again_ns);
}
