/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A board whose milliseconds wrap several times while it waits for a message, without an agent: each tick of its timer counts
 * four hours. The program reads the time at the start and at the end alone. Ends the emulator with status 0 if it is right.
 */
#include "emulator_end.h"

#include <microros/port.h>
#include <microros/port_bare.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>
#include <stdint.h>

enum { STEP_MS = 4 * 60 * 60 * 1000, WRAPS = 4 };

static const int64_t ns_per_ms = 1000000;
static const int64_t epoch_ns = INT64_C(1790000000000000000);
static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription;
static rcl_guard_condition_t guard;
static rclc_executor_t executor;
static std_msgs__msg__Int32 number;
static volatile bool is_over;

/* The clock of the board, in place of that of the port. */
static volatile uint32_t now_ms;
static volatile uint32_t steps;

void port_bare_tick(void)
{
  now_ms = now_ms + (uint32_t)STEP_MS;
  steps = steps + 1u;
  if (steps == (uint32_t)(WRAPS * (INT64_C(1) << 32) / STEP_MS)) {
    is_over = true;
    (void)rcl_trigger_guard_condition(&guard);
  }
}

uint32_t port_time_ms(void)
{
  return now_ms;
}

static void on_number(const void * message)
{
  (void)message;
}

static void on_guard(void)
{
}

/* Whether two readings, a moment apart, differ by the time that has passed since `before_ns`. */
static bool has_passed(int64_t before_ns, int64_t after_ns, int64_t passed_ms)
{
  const int64_t apart_ms = (after_ns - before_ns) / ns_per_ms - passed_ms;

  return apart_ms >= -2 * (int64_t)STEP_MS && apart_ms <= 2 * (int64_t)STEP_MS;
}

static void open_all(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK, 2);
  check(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK, 3);
  check(
    rclc_subscription_init_default(
      &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "first") == RCL_RET_OK,
    4);
  guard = rcl_get_zero_initialized_guard_condition();
  check(
    rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()) ==
      RCL_RET_OK,
    5);
  check(rclc_executor_init(&executor, &support.context, 2, &allocator) == RCL_RET_OK, 6);
  check(
    rclc_executor_add_subscription(&executor, &subscription, &number, on_number, ON_NEW_DATA) == RCL_RET_OK,
    7);
  check(rclc_executor_add_guard_condition(&executor, &guard, on_guard) == RCL_RET_OK, 8);
}

int main(void)
{
  rcl_clock_t system;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_time_point_value_t steady_before = 0;
  rcl_time_point_value_t steady_after = 0;
  rcl_time_point_value_t day_before = 0;
  rcl_time_point_value_t day_after = 0;
  uint32_t start;

  open_all();
  check(rcl_system_clock_init(&system, &allocator) == RCL_RET_OK, 9);
  port_bare_epoch_set(epoch_ns);
  start = steps;
  check(rcl_clock_get_now(&support.clock, &steady_before) == RCL_RET_OK, 10);
  check(rcl_clock_get_now(&system, &day_before) == RCL_RET_OK, 11);
  while (!is_over) {
    check(rclc_executor_spin_some(&executor, (uint64_t)INT64_MAX) == RCL_RET_OK, 12);
  }
  check(rcl_clock_get_now(&support.clock, &steady_after) == RCL_RET_OK, 13);
  check(rcl_clock_get_now(&system, &day_after) == RCL_RET_OK, 14);
  check(has_passed(steady_before, steady_after, (int64_t)(steps - start) * STEP_MS), 15);
  check(has_passed(day_before, day_after, (int64_t)(steps - start) * STEP_MS), 16);
  end(0);
}
