/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The measured life cycle: opens a session and a node; gives it the life cycle; then answers requests of change_state,
 * whose two events are published, and of get_state. Each is done several times: the last one takes in what the agent said
 * to the one before.
 */
#include "measured.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_lifecycle/rclc_lifecycle.h>

/* Indexes of objects: the publisher of events is the first, the services follow by name. */
enum { CHANGE_STATE = 1, GET_STATE = 4 };
enum { TIMES = 8, CONFIGURE = 1, CLEANUP = 2, UNCONFIGURED = 1, INACTIVE = 2 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};

static int on_transition(void)
{
  return RCL_RET_OK;
}

static void check(bool holds)
{
  if (!holds) {
    finish();
  }
}

static void open_life_cycle(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true) == RCL_RET_OK);
  check(rclc_executor_init(&executor, &support.context, 3, &allocator) == RCL_RET_OK);
  check(rclc_lifecycle_init_get_state_server(&context, &executor) == RCL_RET_OK);
  check(rclc_lifecycle_init_get_available_states_server(&context, &executor) == RCL_RET_OK);
  check(rclc_lifecycle_init_change_state_server(&context, &executor) == RCL_RET_OK);
  check(rclc_lifecycle_register_on_configure(&lifecycle, on_transition) == RCL_RET_OK);
  check(rclc_lifecycle_register_on_activate(&lifecycle, on_transition) == RCL_RET_OK);
  check(rclc_lifecycle_register_on_deactivate(&lifecycle, on_transition) == RCL_RET_OK);
  check(rclc_lifecycle_register_on_cleanup(&lifecycle, on_transition) == RCL_RET_OK);
}

/* Receives what waits, without a request among it. */
static void settle(void)
{
  for (int32_t i = 0; i < TIMES; ++i) {
    check(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  }
}

/* Lets the executor run until so many samples were written. */
static void answer_until(uint32_t count)
{
  while (written < count) {
    check(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  }
}

/* A transition by its id, with an empty label. */
static void change_state(uint8_t id)
{
  uint8_t request[9] = {0, 0, 0, 0, 1, 0, 0, 0, 0};

  request[0] = id;
  answer_request(CHANGE_STATE, request, sizeof(request));
  mark();
  answer_until(written + 3u);
  mark();
  settle();
}

static void get_state(void)
{
  static const uint8_t request[1] = {0};

  answer_request(GET_STATE, request, sizeof(request));
  mark();
  answer_until(written + 1u);
  mark();
  settle();
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  mark();
  mark(); /* the distance of these two is the cost of a mark */
  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  check(rclc_node_init_default(&node, "device", "arm", &support) == RCL_RET_OK);
  mark();
  open_life_cycle();
  mark();
  settle();
  for (int32_t i = 0; i < TIMES; ++i) {
    const bool is_even = i % 2 == 0;

    change_state(is_even ? CONFIGURE : CLEANUP);
    check(machine.current_state->id == (is_even ? INACTIVE : UNCONFIGURED));
    get_state();
  }
  mark();
  finish();
  return 0;
}
