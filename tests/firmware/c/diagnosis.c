/* SPDX-License-Identifier: Apache-2.0 */
/* A timer under an executor, which uses more stack after some seconds. */
#include <microros/port.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_diagnosis/declared_checks.h>
#include <rmw_microros/rmw_microros.h>

enum { PERIOD_MS = 20, SPIN_MS = 100, USED = 3000, CALLS = 200, DONE = 1, REFUSED = 2 };

typedef struct diagnosis_report_t {
  uint32_t state;
  uint32_t calls;
  uint32_t sum;
} diagnosis_report_t;

volatile diagnosis_report_t diagnosis_report;

static rclc_support_t support;
static rcl_node_t node;
static rcl_timer_t timer;
static rclc_executor_t executor;

static void use_stack(void)
{
  volatile uint8_t bytes[USED];

  for (uint32_t i = 0; i < (uint32_t)USED; ++i) {
    bytes[i] = (uint8_t)i;
  }
  diagnosis_report.sum = bytes[USED - 1];
}

static void on_timer(rcl_timer_t * called, int64_t last_call_time)
{
  (void)called;
  (void)last_call_time;
  diagnosis_report.calls = diagnosis_report.calls + 1u;
  if (diagnosis_report.calls == (uint32_t)CALLS) {
    use_stack();
  }
}

static rcl_ret_t begin(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(PERIOD_MS), on_timer, true);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 1, &allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_timer(&executor, &timer);
  }
  if (result == RCL_RET_OK) {
    result = rclc_diagnosis_watch((uint8_t)RCLC_CALLBACK_TICK, &timer);
  }
  return result;
}

int main(void)
{
  if (begin() != RCL_RET_OK || rclc_diagnosis_set((uint8_t)DIAGNOSIS_HEAT, INT32_C(-40)) != RCL_RET_OK) {
    diagnosis_report.state = REFUSED;
    return 1;
  }
  diagnosis_report.state = DONE;
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(SPIN_MS));
  }
}
