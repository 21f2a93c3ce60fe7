/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Timers. Times and periods are in nanoseconds. A timer uses one of MICROROS_TIMERS_MAX places. Its callback runs in the
 * task of its executor; any task may call the other functions for a timer that is initialized. No function blocks, and
 * allocators are never called. RCL_RET_TIMER_INVALID: a timer that is not initialized.
 *
 * A timer with a period that the application file declares with `kind: rtos` or `kind: hardware` is driven
 * by a system timer or by the application's hardware timer (microros/port.h): each tick makes it ready and
 * wakes the executor. Other timers are ready when their clock says so.
 */
#ifndef MICROROS_RCL_TIMER_H
#define MICROROS_RCL_TIMER_H

#include <stdbool.h>
#include <stdint.h>

#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/event_callback.h"
#include "rcl/guard_condition.h"
#include "rcl/macros.h"
#include "rcl/time.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_timer_impl_s rcl_timer_impl_t;

typedef struct rcl_timer_s {
  rcl_timer_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_timer_t;

typedef struct rcl_timer_call_info_s {
  rcl_time_point_value_t expected_call_time;
  rcl_time_point_value_t actual_call_time;
} rcl_timer_call_info_t;

/* `last_call_time`: nanoseconds since the previous call, or since the start of the timer. */
typedef void (*rcl_timer_callback_t)(rcl_timer_t * timer, int64_t last_call_time);

rcl_timer_t rcl_get_zero_initialized_timer(void);

/*
 * `timer` must be zero-initialized; it and `clock` must stay at their addresses until rcl_timer_fini. A
 * period of 0 is always ready; the callback may be NULL. Without `autostart` the timer is canceled until
 * rcl_timer_reset. RCL_RET_INVALID_ARGUMENT for a negative period, RCL_RET_ALREADY_INIT, RCL_RET_NOT_INIT
 * for an invalid context, RCL_RET_BAD_ALLOC if all places are in use, RCL_RET_ERROR if the clock has no
 * time, or the system no timer left.
 */
rcl_ret_t rcl_timer_init2(
  rcl_timer_t * timer, rcl_clock_t * clock, rcl_context_t * context, int64_t period,
  const rcl_timer_callback_t callback, rcl_allocator_t allocator, bool autostart);

/* Same with autostart. */
rcl_ret_t rcl_timer_init(
  rcl_timer_t * timer, rcl_clock_t * clock, rcl_context_t * context, int64_t period,
  const rcl_timer_callback_t callback, rcl_allocator_t allocator);

/* Returns RCL_RET_OK for a timer that is not initialized, too. */
rcl_ret_t rcl_timer_fini(rcl_timer_t * timer);

/*
 * Calls the callback, whether the timer is ready or not, and advances the next call by one period, or by
 * several if some were missed: missed calls are not repeated. RCL_RET_TIMER_CANCELED.
 */
rcl_ret_t rcl_timer_call(rcl_timer_t * timer);

/* Same, and returns when the call was due and when it was made. */
rcl_ret_t rcl_timer_call_with_info(rcl_timer_t * timer, rcl_timer_call_info_t * call_info);

rcl_ret_t rcl_timer_clock(const rcl_timer_t * timer, rcl_clock_t ** clock);

/* A canceled timer is not ready. */
rcl_ret_t rcl_timer_is_ready(const rcl_timer_t * timer, bool * is_ready);

/* Negative if the call is overdue. RCL_RET_TIMER_CANCELED. */
rcl_ret_t rcl_timer_get_time_until_next_call(const rcl_timer_t * timer, int64_t * time_until_next_call);

rcl_ret_t rcl_timer_get_time_since_last_call(const rcl_timer_t * timer, int64_t * time_since_last_call);

rcl_ret_t rcl_timer_get_period(const rcl_timer_t * timer, int64_t * period);

/* The next call keeps its time; the new period starts there. */
rcl_ret_t rcl_timer_exchange_period(const rcl_timer_t * timer, int64_t new_period, int64_t * old_period);

/* Returns NULL for an invalid timer, too. */
rcl_timer_callback_t rcl_timer_get_callback(const rcl_timer_t * timer);

rcl_timer_callback_t rcl_timer_exchange_callback(
  rcl_timer_t * timer, const rcl_timer_callback_t new_callback);

rcl_ret_t rcl_timer_cancel(rcl_timer_t * timer);

rcl_ret_t rcl_timer_is_canceled(const rcl_timer_t * timer, bool * is_canceled);

/* Restarts the timer: the next call is due after one period. */
rcl_ret_t rcl_timer_reset(rcl_timer_t * timer);

/* Returns the default allocator, which timers never call; NULL for an invalid timer. */
const rcl_allocator_t * rcl_timer_get_allocator(const rcl_timer_t * timer);

/* Returns the timer's guard condition, which belongs to the timer and ends with it. It is triggered by
 * rcl_timer_reset and by a jump of ROS time that makes the timer ready. NULL for an invalid timer. */
rcl_guard_condition_t * rcl_timer_get_guard_condition(const rcl_timer_t * timer);

/*
 * Calls `on_reset_callback` at each rcl_timer_reset, and once now if there were resets before; NULL
 * removes it. */
rcl_ret_t rcl_timer_set_on_reset_callback(
  const rcl_timer_t * timer, rcl_event_callback_t on_reset_callback, const void * user_data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_TIMER_H */
