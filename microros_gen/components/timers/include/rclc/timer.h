/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Timers on the clock of `support`: the steady clock, or ROS time with `clock: ros`. Codes as for
 * rcl_timer_init2.
 */
#ifndef MICROROS_RCLC_TIMER_H
#define MICROROS_RCLC_TIMER_H

#include "rcl/timer.h"
#include "rclc/types.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* `timeout_ns` is the period. Without `autostart` the timer starts with rcl_timer_reset. */
rcl_ret_t rclc_timer_init_default2(
  rcl_timer_t * timer, rclc_support_t * support, const uint64_t timeout_ns,
  const rcl_timer_callback_t callback, bool autostart);

/* Same with autostart. */
rcl_ret_t rclc_timer_init_default(
  rcl_timer_t * timer, rclc_support_t * support, const uint64_t timeout_ns,
  const rcl_timer_callback_t callback);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_TIMER_H */
