/* SPDX-License-Identifier: Apache-2.0 */
/* Statistics of managed timers: an addition of this client to rcl_lifecycle. */
#ifndef MICROROS_RCL_LIFECYCLE_MANAGED_TIMERS_H
#define MICROROS_RCL_LIFECYCLE_MANAGED_TIMERS_H

#include <stdint.h>

#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct rcl_timer_s;

/*
 * Since the timer was initialized; wraps to 0 after 2^32 - 1. `skipped`: periods that ended without a call because the
 * node of the timer was not active. Periods in which the timer was canceled do not count.
 */
typedef struct rcl_lifecycle_timer_statistics_t {
  uint32_t skipped;
} rcl_lifecycle_timer_statistics_t;

/*
 * Fills the statistics of an initialized timer (rcl_timer_t), all 0 for one that is not managed; does not wait. May be
 * called in any task. Returns RCL_RET_OK, RCL_RET_TIMER_INVALID or RCL_RET_INVALID_ARGUMENT.
 */
rcl_ret_t rcl_lifecycle_get_timer_statistics(
  const struct rcl_timer_s * timer, rcl_lifecycle_timer_statistics_t * statistics);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_MANAGED_TIMERS_H */
