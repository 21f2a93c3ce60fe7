/* SPDX-License-Identifier: Apache-2.0 */
/* What the files of timers share, and what waits for them; internal. */
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
  struct rcl_guard_condition_impl_s * guard; /* NULL: nobody has asked for it */
  size_t resets;                             /* that nobody was told of */
  bool canceled;
  bool woken; /* as rcl_timer_wake says, since the timer began */
};

extern rcl_timer_impl_t rcl_timers[MICROROS_TIMERS_MAX];

/* Returns RCL_RET_OK, RCL_RET_INVALID_ARGUMENT or RCL_RET_TIMER_INVALID, with a text. */
rcl_ret_t rcl_timer_check(const rcl_timer_t * timer);

/* Wakes who waits for the timer or for its guard condition. */
void rcl_timer_wake(rcl_timer_impl_t * timer);

/* The clock of timers jumps, and says `now`; called before and after it does. */
void rcl_timer_on_jump(
  const rcl_clock_t * clock, const rcl_time_jump_t * jump, rcl_time_point_value_t now, bool before_jump);

/*
 * For who waits: gives whether a valid timer is ready, and if not, when to look again at the latest, in nanoseconds:
 * INT64_MAX where somebody wakes who waits.
 */
rcl_ret_t rcl_timer_look(const rcl_timer_t * timer, bool * is_ready, int64_t * look_again_ns);

/* --- one of rcl_timer_source_*.c: what makes timers ready --- */

/* Returns a free place for a timer of this period, or NULL. */
rcl_timer_impl_t * rcl_timer_source_take(int64_t period);

/* The timer begins, with the period that it has; false: the system has no timer for it. */
bool rcl_timer_source_start(const rcl_timer_impl_t * timer);

/* The timer rests. */
void rcl_timer_source_stop(const rcl_timer_impl_t * timer);

/* The timer is about to be called: it is not ready any more. */
void rcl_timer_source_called(const rcl_timer_impl_t * timer);

/* Whether ticks make it ready (true; *is_ready says whether one came), or its clock. */
bool rcl_timer_source_ticks(const rcl_timer_impl_t * timer, bool * is_ready);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_TIMER_INTERNAL_H */
