/* SPDX-License-Identifier: Apache-2.0 */
/* Handles of timers, for rclc/executor.h, which includes this file. */
#ifndef MICROROS_EXECUTOR_TIMER_H
#define MICROROS_EXECUTOR_TIMER_H

#include "rcl/timer.h"
#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The timer's callback is the one passed to its initialization. */
rcl_ret_t rclc_executor_add_timer(rclc_executor_t * executor, rcl_timer_t * timer);

rcl_ret_t rclc_executor_remove_timer(rclc_executor_t * executor, const rcl_timer_t * timer);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_EXECUTOR_TIMER_H */
