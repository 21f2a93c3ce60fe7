/* SPDX-License-Identifier: Apache-2.0 */
/* modes.c without modes: what remains is the life cycle and the parameters. */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_lifecycle/rclc_lifecycle.h>
#include <rclc_parameter/declared_parameters.h>

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};
static rclc_parameter_server_t parameters;
static arm_device_parameters_t values;

volatile uint32_t modes_report[4];

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 3 + RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES, &allocator) !=
      RCL_RET_OK ||
    rclc_parameter_server_init_default(&parameters, &node) != RCL_RET_OK ||
    arm_device_parameters_declare(&parameters) != RCL_RET_OK ||
    rclc_executor_add_parameter_server(&executor, &parameters, NULL) != RCL_RET_OK ||
    rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true) != RCL_RET_OK ||
    rclc_lifecycle_init_get_state_server(&context, &executor) != RCL_RET_OK ||
    rclc_lifecycle_init_get_available_states_server(&context, &executor) != RCL_RET_OK ||
    rclc_lifecycle_init_change_state_server(&context, &executor) != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
    (void)arm_device_parameters_update(&values, &parameters);
    modes_report[0] = machine.current_state->id;
    modes_report[2] = (uint32_t)(values.speed * 1000.0);
  }
}
