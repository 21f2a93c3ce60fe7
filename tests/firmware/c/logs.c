/* SPDX-License-Identifier: Apache-2.0 */
/* Logs before the session, in it, and many at once; logs_report says how many the library dropped. */
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rcutils/logging_macros.h>
#include <rmw_microros/rmw_microros.h>

enum { MANY = 60, TURN_MS = 5, DONE = 1, REFUSED = 2 };

typedef struct logs_report_t {
  uint32_t done;
  uint32_t dropped;
} logs_report_t;

volatile logs_report_t logs_report;

static rclc_support_t support;
static rcl_node_t node;

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  RCUTILS_LOG_INFO_NAMED("board", "before the session");
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK) {
    logs_report.done = REFUSED;
    return 1;
  }
  for (int i = 0; i < MANY; ++i) {
    RCUTILS_LOG_WARN_NAMED("board", "burst %d", i);
  }
  logs_report.dropped = rcutils_logging_get_counts().dropped;
  logs_report.done = DONE;
  for (;;) {
    (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
    rclc_sleep_ms(TURN_MS);
  }
}
