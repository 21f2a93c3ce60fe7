/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with a life cycle: one call for each line of standard input, answered with lines and "ret CODE TEXT".
 * Meanwhile the executor spins. What a callback returns is set by a line; each call of one is counted. Once a callback
 * can also do something while the node is in the state of its transition: change the state, or wait for the next line,
 * with or without spinning.
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

static int inside = CALLBACKS; /* which callback does something, once */
static char inside_what;        /* c: change the state by all ids, the last one `inside_last`; s: spin; b: block */
static unsigned int inside_last;

static void try_change(unsigned int id)
{
  const rcl_ret_t result = rclc_lifecycle_change_state(&lifecycle, id, true);

  rcl_reset_error();
  (void)printf("inside %u %d %u\n", id, (int)result, machine.current_state->id);
}

/* Ids that leave the state of the transition are left to `inside_last`. */
static void change_inside(void)
{
  for (unsigned int id = 0; id < 300u; ++id) {
    if (id > UINT8_MAX || rcl_lifecycle_get_transition_by_id(machine.current_state, (uint8_t)id) == NULL) {
      try_change(id);
    }
  }
  if (inside_last != 0u) {
    try_change(inside_last);
  }
}

static void wait_inside(bool spins)
{
  struct pollfd input = {0, POLLIN, 0};

  while (poll(&input, 1, spins ? 0 : -1) == 0) {
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(2)), "a spin within a callback");
  }
}

static int called(int which)
{
  ++calls[which];
  if (inside == which) {
    inside = CALLBACKS;
    if (inside_what == 'c') {
      change_inside();
    } else {
      wait_inside(inside_what == 's');
    }
  }
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

/* Goes from each state by each id, or by a label; prints state, id and goal of what exists. */
static void print_table(const char * label)
{
  for (unsigned int i = 1; i < machine.transition_map.states_size; ++i) {
    for (unsigned int id = 0; id <= (label == NULL ? UINT8_MAX : 0u); ++id) {
      machine.current_state = &machine.transition_map.states[i];
      if (
        (label == NULL ? rcl_lifecycle_trigger_transition_by_id(&machine, (uint8_t)id, false)
                       : rcl_lifecycle_trigger_transition_by_label(&machine, label, false)) == RCL_RET_OK) {
        (void)printf("%s %u %s\n", machine.transition_map.states[i].label, id, machine.current_state->label);
      }
      rcl_reset_error();
    }
  }
  machine.current_state = &machine.transition_map.states[1];
}

static void print_transitions(void)
{
  for (unsigned int i = 1; i < machine.transition_map.states_size; ++i) {
    const rcl_lifecycle_state_t * state = &machine.transition_map.states[i];

    for (unsigned int j = 0; j < state->valid_transition_size; ++j) {
      const rcl_lifecycle_transition_t * transition = &state->valid_transitions[j];

      (void)printf(
        "%u %s %s %s\n", transition->id, transition->label, transition->start->label, transition->goal->label);
    }
  }
}

/* What needs no new node. */
static bool run_on_machine(char ** word)
{
  const char * what = word[0];

  if (strcmp(what, "inside") == 0) {
    inside = atoi(word[1]);
    inside_what = word[2][0];
    inside_last = word[3] != NULL ? (unsigned int)atoi(word[3]) : 0u;
  } else if (strcmp(what, "place") == 0) {
    machine.current_state = &machine.transition_map.states[atoi(word[1])];
  } else if (strcmp(what, "table") == 0) {
    print_table(word[1]);
  } else if (strcmp(what, "transitions") == 0) {
    print_transitions();
  } else {
    return false;
  }
  return true;
}

/*
 * outcome INDEX CODE | change ID | trigger ID | state | calls | reset | inside INDEX c|s|b [ID] | place STATE |
 * table [LABEL] | transitions
 */
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
  } else if (!run_on_machine(word)) {
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
