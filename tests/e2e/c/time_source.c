/* SPDX-License-Identifier: Apache-2.0 */
/* Follows the agent's time until ten samples are taken; prints how far it is from the time of this machine, microseconds,
 * and the counts of samples and outliers. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <stdio.h>
#include <time.h>

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_uros_time_status_t status = {RMW_UROS_TIME_UNSET, 0, 0, 0, 0, 0, 0, 0};
  rclc_support_t support;
  struct timespec now;
  int64_t error_ns;

  if (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    return 1;
  }
  while (status.accepted < 10u) {
    const struct timespec pause = {0, 1000000};

    if (
      rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)) != RMW_RET_OK ||
      rmw_uros_time_source_status(&status) != RMW_RET_OK) {
      return 2;
    }
    (void)nanosleep(&pause, NULL);
  }
  (void)clock_gettime(CLOCK_REALTIME, &now);
  error_ns = rmw_uros_epoch_nanos() - ((int64_t)now.tv_sec * 1000000000 + now.tv_nsec);
  printf(
    "%lld %u %u %d\n", (long long)(error_ns / 1000), (unsigned)status.accepted, (unsigned)status.rejected,
    (int)status.state);
  return rclc_support_fini(&support) == RCL_RET_OK ? 0 : 3;
}
