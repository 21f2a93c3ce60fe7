/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A parameter server with four parameters under an executor: its size is a figure of docs/verification/figures.md.
 * `parameters_report` has what the firmware does with a parameter: twice the steps, and how often these changed. The
 * application file declares the parameters, or (PARAMETERS_ADDED) this program adds them, as sources for rclc do.
 */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#ifdef PARAMETERS_ADDED
#include <rclc_parameter/rclc_parameter.h>
#else
#include <rclc_parameter/declared_parameters.h>
#endif

enum { STEPS_VETOED = 66 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_parameter_server_t server;

volatile uint32_t parameters_report[2];

static bool on_parameter(const Parameter * old_param, const Parameter * new_param, void * context)
{
  (void)old_param;
  (void)context;
  if (new_param->value.type == RCLC_PARAMETER_INT) {
    if (new_param->value.integer_value == STEPS_VETOED) {
      return false;
    }
    ++parameters_report[1];
  }
  return true;
}

#ifdef PARAMETERS_ADDED
static bool add_parameters(void)
{
  return rclc_add_parameter(&server, "enabled", RCLC_PARAMETER_BOOL) == RCL_RET_OK &&
         rclc_add_parameter(&server, "motor.steps", RCLC_PARAMETER_INT) == RCL_RET_OK &&
         rclc_add_parameter(&server, "motor.gain", RCLC_PARAMETER_DOUBLE) == RCL_RET_OK &&
         rclc_add_parameter(&server, "version", RCLC_PARAMETER_INT) == RCL_RET_OK &&
         rclc_parameter_set_int(&server, "motor.steps", 10) == RCL_RET_OK &&
         rclc_add_parameter_constraint_integer(&server, "motor.steps", 0, 120, 2) == RCL_RET_OK &&
         rclc_set_parameter_read_only(&server, "version", true) == RCL_RET_OK;
}
#else
static bool add_parameters(void)
{
  return arm_device_parameters_declare(&server) == RCL_RET_OK;
}
#endif

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK ||
    rclc_parameter_server_init_default(&server, &node) != RCL_RET_OK || !add_parameters() ||
    rclc_executor_init(&executor, &support.context, RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES, &allocator) !=
      RCL_RET_OK ||
    rclc_executor_add_parameter_server(&executor, &server, on_parameter) != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    int64_t steps = 0;

    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
    if (rclc_parameter_get_int(&server, "motor.steps", &steps) == RCL_RET_OK) {
      parameters_report[0] = 2u * (uint32_t)steps;
    }
  }
}
