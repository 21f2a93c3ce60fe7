/* SPDX-License-Identifier: Apache-2.0 */
/* Logs and fails without ever reaching its agent; after the restart it connects, and the lines are published. */
#include <microros/port.h>
#include <microros/port_bare.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rcutils/logging_macros.h>
#include <rmw_microros/rmw_microros.h>

enum { LINES = 3, TURN_MS = 5, DONE = 1, REFUSED = 2 };

typedef struct ring_report_t {
  uint32_t done;
} ring_report_t;

volatile ring_report_t ring_report;

static volatile uintptr_t address = FAULT_ADDRESS;
static rclc_support_t support;
static rcl_node_t node;

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  port_bare_fault_t fault;

  if (!port_bare_fault_take(&fault)) {
    for (int i = 0; i < LINES; ++i) {
      RCUTILS_LOG_DEBUG_NAMED("board", "before the fault %d", i);
    }
    *(volatile uint32_t *)address = 1u;
  }
  RCUTILS_LOG_WARN_NAMED("board", "after the fault %u", (unsigned)fault.cause);
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK) {
    ring_report.done = REFUSED;
    return 1;
  }
  ring_report.done = DONE;
  for (;;) {
    (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
    rclc_sleep_ms(TURN_MS);
  }
}
