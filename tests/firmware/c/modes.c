/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with modes under an executor: its size is a figure of docs/verification/figures.md. `modes_report` has the state,
 * the mode, a parameter in thousandths, and how often the callback of modes was called. A non-zero `modes_wanted`
 * reconfigures the node: the mode at that position plus one.
 *
 * With MODES_DRIVEN a test drives it by parameters: `brake` refuses FAST as a whole, a `limit` of 0.5 refuses each
 * change of `gain`, and with a `limit` above 9 the callback of modes takes two seconds, in which `modes_held` is 1.
 */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_modes/declared_modes.h>
#include <rclc_parameter/declared_parameters.h>
#include <string.h>

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};
static rclc_parameter_server_t parameters;
static rclc_modes_t modes;
static arm_device_parameters_t values;

volatile uint32_t modes_report[4];
volatile uint32_t modes_wanted;

#ifdef MODES_DRIVEN
#include <microros/port.h>

enum { FAST = 2, HELD_MS = 2000 };

volatile uint32_t modes_held;

static void hold(void)
{
  const uint32_t begun_ms = port_time_ms();

  modes_held = 1;
  while (port_time_ms() - begun_ms < (uint32_t)HELD_MS) {
  }
  modes_held = 0;
}

static bool accepts(uint8_t goal_mode)
{
  (void)arm_device_parameters_update(&values, &parameters);
  if (values.limit > 9.0) {
    hold();
  }
  return goal_mode != (uint8_t)FAST || !values.brake;
}

static bool on_modification(const Parameter * old_param, const Parameter * new_param, void * unused)
{
  (void)unused;
  return old_param == NULL || new_param == NULL || strcmp(new_param->name.data, "gain") != 0 || values.limit != 0.5;
}
#define ON_MODIFICATION on_modification
#else
static bool accepts(uint8_t goal_mode)
{
  return goal_mode < 3u;
}
#define ON_MODIFICATION NULL
#endif

static bool on_mode(uint8_t start_mode, uint8_t goal_mode, void * unused)
{
  (void)unused;
  modes_report[3] = modes_report[3] + 1u;
  return start_mode < 3u && accepts(goal_mode);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK ||
    rclc_executor_init(
      &executor, &support.context, 3 + RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES + RCLC_EXECUTOR_MODES_HANDLES,
      &allocator) != RCL_RET_OK ||
    rclc_parameter_server_init_default(&parameters, &node) != RCL_RET_OK ||
    arm_device_parameters_declare(&parameters) != RCL_RET_OK ||
    rclc_executor_add_parameter_server(&executor, &parameters, ON_MODIFICATION) != RCL_RET_OK ||
    rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true) != RCL_RET_OK ||
    rclc_lifecycle_init_get_state_server(&context, &executor) != RCL_RET_OK ||
    rclc_lifecycle_init_get_available_states_server(&context, &executor) != RCL_RET_OK ||
    rclc_lifecycle_init_change_state_server(&context, &executor) != RCL_RET_OK ||
    rclc_modes_init(&modes, &arm_device_modes, &lifecycle, &parameters) != RCL_RET_OK ||
    rclc_executor_add_modes(&executor, &modes, on_mode, NULL) != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
    if (modes_wanted != 0u) {
      (void)rclc_modes_reconfigure(&modes, (uint8_t)(modes_wanted - 1u));
      modes_wanted = 0;
    }
    (void)arm_device_parameters_update(&values, &parameters);
    modes_report[0] = machine.current_state->id;
    modes_report[1] = rclc_modes_get(&modes);
    modes_report[2] = (uint32_t)(values.speed * 1000.0);
  }
}
