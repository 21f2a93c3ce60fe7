/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the source files of timers and by waiting functions; internal. */
#ifndef MICROROS_RCL_TIMER_INTERNAL_H
#define MICROROS_RCL_TIMER_INTERNAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros_config.h"
#include "rcl/timer.h"

#ifdef __cplusplus
extern "C" {
#endif

struct rcl_timer_impl_s {
  int64_t period;
  int64_t last_call_time;
  int64_t next_call_time;
  rcl_clock_t * clock; /* NULL: the place is free */
  rcl_timer_callback_t callback;
  rcl_event_callback_t on_reset;
  const void * on_reset_data;
  struct rcl_guard_condition_impl_s * guard; /* NULL: not requested */
  size_t resets;                             /* resets not yet reported */
  bool canceled;
  bool woken; /* rcl_timer_wake was called since the timer's initialization */
};

extern rcl_timer_impl_t rcl_timers[MICROROS_TIMERS_MAX];

/* Returns RCL_RET_OK, RCL_RET_INVALID_ARGUMENT or RCL_RET_TIMER_INVALID, with a text. */
rcl_ret_t rcl_timer_check(const rcl_timer_t * timer);

/* Wakes tasks that wait for the timer or for its guard condition. Called with the lock, as rcl_timer_on_jump and the source
 * of ticks. */
void rcl_timer_wake(rcl_timer_impl_t * timer);

/* Handles a jump of the timers' clock to `now`; called before and after it. */
void rcl_timer_on_jump(
  const rcl_clock_t * clock, const rcl_time_jump_t * jump, rcl_time_point_value_t now, bool before_jump);

/*
 * For waiting functions: returns whether a valid timer is ready, and if not, the latest time in
 * nanoseconds to look again; INT64_MAX if a wake-up will follow.
 */
rcl_ret_t rcl_timer_look(const rcl_timer_t * timer, bool * is_ready, int64_t * look_again_ns);

/* --- source of ticks, implemented by one of rcl_timer_source_*.c --- */

/* Returns a free place for a timer of this period, or NULL. */
rcl_timer_impl_t * rcl_timer_source_take(int64_t period);

/* Starts a timer with its period; false if the system has no timer left. */
bool rcl_timer_source_start(const rcl_timer_impl_t * timer);

/* Stops a timer. */
void rcl_timer_source_stop(const rcl_timer_impl_t * timer);

/* Called before the callback: clears the ready state. */
void rcl_timer_source_called(const rcl_timer_impl_t * timer);

/* Returns whether ticks drive the timer (*is_ready: one is pending), rather than its clock. */
bool rcl_timer_source_ticks(const rcl_timer_impl_t * timer, bool * is_ready);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_TIMER_INTERNAL_H */
