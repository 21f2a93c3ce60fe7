/* SPDX-License-Identifier: Apache-2.0 */
/* No timer is managed. */
#include "microros/error.h"
#include "microros/rcl_lifecycle_timers.h"
#include "rcl_lifecycle/managed_timers.h"

#include <stddef.h>

void rcl_lifecycle_timers_start(const rcl_node_t * node)
{
  (void)node;
}

rcl_ret_t rcl_lifecycle_get_timer_statistics(
  const struct rcl_timer_s * timer, rcl_lifecycle_timer_statistics_t * statistics)
{
  if (timer == NULL || statistics == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "timer or statistics");
  }
  statistics->skipped = 0;
  return RCL_RET_OK;
}
