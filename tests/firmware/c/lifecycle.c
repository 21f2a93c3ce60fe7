/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with a life cycle under an executor: its size is a figure of docs/verification/figures.md. `lifecycle_report`
 * has the state and how often each of the four callbacks was called.
 */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_lifecycle/rclc_lifecycle.h>

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};

volatile uint32_t lifecycle_report[5];

static int called(int which)
{
  lifecycle_report[which] = lifecycle_report[which] + 1u;
  return RCL_RET_OK;
}

static int on_configure(void)
{
  return called(1);
}

static int on_activate(void)
{
  return called(2);
}

static int on_deactivate(void)
{
  return called(3);
}

static int on_cleanup(void)
{
  return called(4);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK ||
    rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true) != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 4, &allocator) != RCL_RET_OK ||
    rclc_lifecycle_init_get_state_server(&context, &executor) != RCL_RET_OK ||
    rclc_lifecycle_init_get_available_states_server(&context, &executor) != RCL_RET_OK ||
    rclc_lifecycle_init_change_state_server(&context, &executor) != RCL_RET_OK ||
    rclc_lifecycle_register_on_configure(&lifecycle, on_configure) != RCL_RET_OK ||
    rclc_lifecycle_register_on_activate(&lifecycle, on_activate) != RCL_RET_OK ||
    rclc_lifecycle_register_on_deactivate(&lifecycle, on_deactivate) != RCL_RET_OK ||
    rclc_lifecycle_register_on_cleanup(&lifecycle, on_cleanup) != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
    lifecycle_report[0] = machine.current_state->id;
  }
}
