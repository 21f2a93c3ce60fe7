/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with modes, a timer and checks under an executor, in the hands of a test: "set NUMBER" sets the battery, "busy
 * NUMBER" lets the next callback of the timer take so many milliseconds, "fail" makes an error, "refuse" and "accept"
 * say what the callback of modes does, "activate" changes the state, "show" prints mode and level, "times" the numbers of
 * the timer's callback: runs, last and longest microseconds, overruns.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_diagnosis/declared_checks.h>
#include <rclc_modes/declared_modes.h>
#include <rclc_parameter/declared_parameters.h>

#include "commanded.h"

enum { HANDLES = 4 + RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES + RCLC_EXECUTOR_MODES_HANDLES, PERIOD_MS = 20 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_timer_t timer;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};
static rclc_parameter_server_t parameters;
static rclc_modes_t modes;
static bool refuses;
static int busy_ms;

static bool on_mode(uint8_t start_mode, uint8_t goal_mode, void * unused)
{
  (void)start_mode;
  (void)goal_mode;
  (void)unused;
  return !refuses;
}

static void on_timer(rcl_timer_t * called, int64_t last_call_time)
{
  struct timespec left = {busy_ms / 1000, (long)(busy_ms % 1000) * 1000000};

  (void)called;
  (void)last_call_time;
  busy_ms = 0;
  (void)nanosleep(&left, NULL);
}

static void begin(void)
{
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "arm", &support), "node");
  check(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(PERIOD_MS), on_timer, true), "timer");
  check(rclc_executor_init(&executor, &support.context, HANDLES, &allocator), "executor");
  check(rclc_executor_add_timer(&executor, &timer), "timer of the executor");
  check(rclc_diagnosis_watch((uint8_t)RCLC_CALLBACK_TICK, &timer), "callback of the timer");
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

static rcl_ret_t activate(void)
{
  const rcl_ret_t result =
    rclc_lifecycle_change_state(&lifecycle, lifecycle_msgs__msg__Transition__TRANSITION_CONFIGURE, true);

  return result == RCL_RET_OK ? rclc_lifecycle_change_state(
                                  &lifecycle, lifecycle_msgs__msg__Transition__TRANSITION_ACTIVATE, true)
                              : result;
}

static rcl_ret_t print_times(void)
{
  rclc_diagnosis_callback_t times;
  const rcl_ret_t result = rclc_diagnosis_get_callback((uint8_t)RCLC_CALLBACK_TICK, &times);

  if (result == RCL_RET_OK) {
    (void)printf(
      "%lu %lu %lu %lu\n", (unsigned long)times.runs, (unsigned long)times.last_us,
      (unsigned long)times.longest_us, (unsigned long)times.overruns);
  }
  return result;
}

/* set NUMBER | busy MS | refuse | accept | activate | fail | show | times */
static rcl_ret_t run(char ** words)
{
  const char * what = words[0];

  if (strcmp(what, "set") == 0) {
    return rclc_diagnosis_set((uint8_t)DIAGNOSIS_BATTERY, (int32_t)atoi(words[1]));
  }
  if (strcmp(what, "activate") == 0) {
    return activate();
  }
  if (strcmp(what, "times") == 0) {
    return print_times();
  }
  if (strcmp(what, "fail") == 0) {
    return rclc_diagnosis_set(99u, 0);
  }
  if (strcmp(what, "busy") == 0) {
    busy_ms = atoi(words[1]);
  } else if (strcmp(what, "show") == 0) {
    (void)printf("%s %u\n", rclc_modes_name(&modes, rclc_modes_get(&modes)), rclc_diagnosis_level(0));
  } else {
    refuses = strcmp(what, "refuse") == 0;
  }
  return RCL_RET_OK;
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  begin();
  obey(&executor, 20, run);
  check(rclc_modes_fini(&modes), "modes fini");
  check(rclc_lifecycle_node_fini(&lifecycle, &allocator), "life cycle fini");
  check(rclc_parameter_server_fini(&parameters, &node), "parameters fini");
  check(rclc_executor_fini(&executor), "executor fini");
  check(rcl_timer_fini(&timer), "timer fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
