/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/timer.h"

#include "microros/error.h"

#include <stddef.h>

/* As in rclc, *timer may be uninitialized memory. */
rcl_ret_t rclc_timer_init_default2(
  rcl_timer_t * timer, rclc_support_t * support, const uint64_t timeout_ns,
  const rcl_timer_callback_t callback, bool autostart)
{
  if (timer == NULL || support == NULL || support->allocator == NULL || timeout_ns > (uint64_t)INT64_MAX) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "timer, support or timeout_ns");
  }
  *timer = rcl_get_zero_initialized_timer();
  return rcl_timer_init2(
    timer, &support->clock, &support->context, (int64_t)timeout_ns, callback, *support->allocator, autostart);
}

rcl_ret_t rclc_timer_init_default(
  rcl_timer_t * timer, rclc_support_t * support, const uint64_t timeout_ns,
  const rcl_timer_callback_t callback)
{
  return rclc_timer_init_default2(timer, support, timeout_ns, callback, true);
}
