/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with a life cycle: one call for each line of standard input, answered with lines and "ret CODE TEXT".
 * Meanwhile the executor spins. What a callback returns is set by a line; each call of one is counted.
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
#include <rclc_lifecycle/rclc_lifecycle.h>

#include "commanded.h"

enum { CONFIGURE, ACTIVATE, DEACTIVATE, CLEANUP, SHUTDOWN, ERROR, CALLBACKS };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};
static int outcomes[CALLBACKS];
static int calls[CALLBACKS];

static int called(int which)
{
  ++calls[which];
  return outcomes[which];
}

static int on_configure(void)
{
  return called(CONFIGURE);
}

static int on_activate(void)
{
  return called(ACTIVATE);
}

static int on_deactivate(void)
{
  return called(DEACTIVATE);
}

static int on_cleanup(void)
{
  return called(CLEANUP);
}

static int on_shutdown(void)
{
  return called(SHUTDOWN);
}

static int on_error(void)
{
  return called(ERROR);
}

static void begin(void)
{
  static const unsigned int shutdowns[] = {
    lifecycle_msgs__msg__Transition__TRANSITION_UNCONFIGURED_SHUTDOWN,
    lifecycle_msgs__msg__Transition__TRANSITION_INACTIVE_SHUTDOWN,
    lifecycle_msgs__msg__Transition__TRANSITION_ACTIVE_SHUTDOWN};

  check(rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true), "life cycle");
  check(rclc_executor_init(&executor, &support.context, 3, &allocator), "executor");
  check(rclc_lifecycle_init_get_state_server(&context, &executor), "get_state");
  check(rclc_lifecycle_init_get_available_states_server(&context, &executor), "get_available_states");
  check(rclc_lifecycle_init_change_state_server(&context, &executor), "change_state");
  check(rclc_lifecycle_register_on_configure(&lifecycle, on_configure), "on_configure");
  check(rclc_lifecycle_register_on_activate(&lifecycle, on_activate), "on_activate");
  check(rclc_lifecycle_register_on_deactivate(&lifecycle, on_deactivate), "on_deactivate");
  check(rclc_lifecycle_register_on_cleanup(&lifecycle, on_cleanup), "on_cleanup");
  for (size_t i = 0; i < sizeof(shutdowns) / sizeof(shutdowns[0]); ++i) {
    check(rclc_lifecycle_register_callback(&lifecycle, shutdowns[i], on_shutdown), "on_shutdown");
  }
  check(
    rclc_lifecycle_register_callback(
      &lifecycle, lifecycle_msgs__msg__State__TRANSITION_STATE_ERRORPROCESSING, on_error),
    "on_error");
}

static void end(void)
{
  check(rclc_executor_fini(&executor), "executor fini");
  check(rclc_lifecycle_node_fini(&lifecycle, &allocator), "life cycle fini");
}

static void print_calls(void)
{
  (void)printf("calls");
  for (int i = 0; i < CALLBACKS; ++i) {
    (void)printf(" %d", calls[i]);
    calls[i] = 0;
  }
  (void)printf("\n");
}

/* outcome INDEX CODE | change ID | trigger ID | state | calls | reset */
static rcl_ret_t run(char ** word)
{
  const char * what = word[0];

  if (strcmp(what, "outcome") == 0) {
    outcomes[atoi(word[1])] = atoi(word[2]);
  } else if (strcmp(what, "change") == 0) {
    return rclc_lifecycle_change_state(&lifecycle, (unsigned int)atoi(word[1]), true);
  } else if (strcmp(what, "trigger") == 0) {
    return rcl_lifecycle_trigger_transition_by_id(&machine, (uint8_t)atoi(word[1]), false);
  } else if (strcmp(what, "state") == 0) {
    (void)printf("%u %s\n", machine.current_state->id, machine.current_state->label);
  } else if (strcmp(what, "calls") == 0) {
    print_calls();
  } else if (strcmp(what, "reset") == 0) {
    end();
    begin();
  } else {
    return RCL_RET_INVALID_ARGUMENT;
  }
  return RCL_RET_OK;
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "arm", &support), "node");
  begin();
  obey(&executor, 2, run);
  end();
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
