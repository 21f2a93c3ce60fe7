/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Publishes 1 to COUNTER_LAST on `count`, reliable, each until a stream has taken it, and keeps what happened where the
 * test's monitor finds it: in counter_report.
 */
#include <microros/port_bare.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#ifndef COUNTER_PERIOD_MS
#define COUNTER_PERIOD_MS 5u
#endif

enum { FLUSH_MS = 10000 };

typedef struct counter_report_t {
  uint32_t done; /* 1: everything was published and acknowledged */
  uint32_t published;
  uint32_t refused; /* calls of rcl_publish that had to be repeated */
  uint32_t resent;
  uint32_t malformed;
  uint32_t dropped;
  uint32_t reconnects;
  uint32_t lost; /* bytes of the line */
  uint32_t stack;
  uint32_t fault; /* its cause, 0 without one */
} counter_report_t;

volatile counter_report_t counter_report;

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;

static void report(void)
{
  rmw_uros_statistics_t statistics;

  if (rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics) == RMW_RET_OK) {
    counter_report.resent = statistics.resent;
    counter_report.malformed = statistics.malformed;
    counter_report.dropped = statistics.dropped;
    counter_report.reconnects = statistics.reconnects;
  }
  counter_report.lost = port_bare_serial_lost();
  counter_report.stack = port_bare_stack_peak();
}

static bool start(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  while (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    rcl_reset_error();
  }
  return rclc_node_init_default(&node, "counter", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_default(
           &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") == RCL_RET_OK;
}

static void publish(int32_t value)
{
  std_msgs__msg__Int32 message = {value};

  while (rcl_publish(&publisher, &message, NULL) != RCL_RET_OK) {
    rcl_reset_error();
    counter_report.refused = counter_report.refused + 1u;
    rclc_sleep_ms(COUNTER_PERIOD_MS);
  }
  counter_report.published = (uint32_t)value;
}

int main(void)
{
  port_bare_fault_t fault;

  if (port_bare_fault_take(&fault)) {
    counter_report.fault = fault.cause;
  }
  if (!start()) {
    return 1;
  }
  for (int32_t value = 1; value <= COUNTER_LAST; ++value) {
    publish(value);
    report();
    rclc_sleep_ms(COUNTER_PERIOD_MS);
  }
  if (rmw_uros_flush(rcl_context_get_rmw_context(&support.context), FLUSH_MS) == RMW_RET_OK) {
    counter_report.done = 1;
  }
  for (;;) {
    (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
    report();
    rclc_sleep_ms(COUNTER_PERIOD_MS);
  }
}
