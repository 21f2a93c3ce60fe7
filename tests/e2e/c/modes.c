/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with modes under an executor, in the hands of a test. "refuse" and "accept" say what the callback of modes
 * does; "show" prints the speed and the state.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_modes/declared_modes.h>
#include <rclc_parameter/declared_parameters.h>

#include "commanded.h"

enum { HANDLES = 3 + RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES + RCLC_EXECUTOR_MODES_HANDLES };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};
static rclc_parameter_server_t parameters;
static rclc_modes_t modes;
static arm_device_parameters_t values;
static bool refuses;

static bool on_mode(uint8_t start_mode, uint8_t goal_mode, void * unused)
{
  (void)start_mode;
  (void)goal_mode;
  (void)unused;
  return !refuses;
}

static void begin(void)
{
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "arm", &support), "node");
  check(rclc_executor_init(&executor, &support.context, HANDLES, &allocator), "executor");
  check(rclc_parameter_server_init_default(&parameters, &node), "parameters");
  check(arm_device_parameters_declare(&parameters), "declarations");
  check(rclc_executor_add_parameter_server(&executor, &parameters, NULL), "parameter server");
  check(rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true), "life cycle");
  check(rclc_lifecycle_init_get_state_server(&context, &executor), "get_state");
  check(rclc_lifecycle_init_get_available_states_server(&context, &executor), "get_available_states");
  check(rclc_lifecycle_init_change_state_server(&context, &executor), "change_state");
  check(rclc_modes_init(&modes, &arm_device_modes, &lifecycle, &parameters), "modes");
  check(rclc_executor_add_modes(&executor, &modes, on_mode, NULL), "services of modes");
}

/* reconfigure MODE | refuse | accept | show */
static rcl_ret_t run(char ** words)
{
  if (strcmp(words[0], "reconfigure") == 0) {
    return rclc_modes_reconfigure(&modes, rclc_modes_find(&modes, words[1]));
  }
  if (strcmp(words[0], "show") != 0) {
    refuses = strcmp(words[0], "refuse") == 0;
    return RCL_RET_OK;
  }
  (void)arm_device_parameters_update(&values, &parameters);
  (void)printf("%.2f %s\n", values.speed, machine.current_state->label);
  return RCL_RET_OK;
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  begin();
  obey(&executor, 2, run);
  check(rclc_modes_fini(&modes), "modes fini");
  check(rclc_lifecycle_node_fini(&lifecycle, &allocator), "life cycle fini");
  check(rclc_parameter_server_fini(&parameters, &node), "parameters fini");
  check(rclc_executor_fini(&executor), "executor fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
