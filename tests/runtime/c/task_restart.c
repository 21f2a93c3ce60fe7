/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One task is stopped and started again while the others run: from outside and from another task. The application file is
 * that of test_tasks.py.
 */
#include "unit.h"

#include <microros/port.h>
#include <microros/port_tasks.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

enum { SOME = 20, KEPT = 5, TURNS = 4, STOPS_CONTROL = -1 };

static rcl_publisher_t publisher;
static uint32_t heard; /* the lock of the port guards these */
static bool restarts_worker;
static bool is_restarted;
static bool main_stops;
static bool is_in_callback;

static bool get(const bool * what)
{
  bool value;

  port_lock();
  value = *what;
  port_unlock();
  return value;
}

static void set(bool * what, bool value)
{
  port_lock();
  *what = value;
  port_unlock();
}

static void wait_for(const bool * what)
{
  while (!get(what)) {
    port_sleep_ms(1);
  }
}

static uint32_t heard_now(void)
{
  uint32_t value;

  port_lock();
  value = heard;
  port_unlock();
  return value;
}

static void wait_for_heard(uint32_t count)
{
  while (heard_now() < count) {
    port_sleep_ms(1);
  }
}

static rclc_task_counters_t counters_of(uint8_t task)
{
  rclc_task_counters_t counters;

  CHECK(rclc_task_get_counters(task, &counters) == RCL_RET_OK);
  return counters;
}

static void wait_for_runs(uint8_t task, uint32_t count)
{
  const uint32_t before = counters_of(task).runs;

  while (counters_of(task).runs - before < count) {
    port_sleep_ms(1);
  }
}

static void publish(int32_t value)
{
  const std_msgs__msg__Int32 message = {.data = value};

  CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
}

static void on_release(uint8_t task)
{
  if (get(&restarts_worker)) {
    set(&restarts_worker, false);
    CHECK(rclc_task_stop(task) == RCL_RET_ERROR); /* not itself */
    CHECK(rclc_task_stop(RCLC_TASK_WORKER) == RCL_RET_OK);
    CHECK(rclc_task_start(RCLC_TASK_WORKER) == RCL_RET_OK);
    set(&is_restarted, true);
  }
}

/* The last message: the caller of rclc_task_stop waits for this task, which must not wait for another one meanwhile. */
static void on_message(const void * message)
{
  const std_msgs__msg__Int32 * number = message;

  CHECK(port_task_self() == RCLC_TASK_WORKER);
  if (number->data == (int32_t)STOPS_CONTROL) {
    set(&is_in_callback, true);
    wait_for(&main_stops);
    port_sleep_ms(50); /* most likely it waits now */
    CHECK(rclc_task_stop(RCLC_TASK_CONTROL) == RCL_RET_ERROR);
  }
  port_lock();
  ++heard;
  port_unlock();
}

static void check_refusals(void)
{
  CHECK(rclc_task_stop(RCLC_TASK_SESSION) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_task_start(RCLC_TASK_SESSION) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_task_stop(MICROROS_TASKS) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_task_start(RCLC_TASK_WORKER) == RCL_RET_ERROR); /* it runs */
}

/* It has the counters of before, and neither runs nor releases are counted meanwhile. */
static void check_period(void)
{
  rclc_task_counters_t before;
  uint32_t peak;

  wait_for_runs(RCLC_TASK_CONTROL, SOME);
  CHECK(rclc_task_stop(RCLC_TASK_CONTROL) == RCL_RET_OK);
  before = counters_of(RCLC_TASK_CONTROL);
  CHECK(rclc_task_stop(RCLC_TASK_CONTROL) == RCL_RET_ERROR);
  CHECK(rclc_task_set_priority(RCLC_TASK_CONTROL, 1) == RCL_RET_ERROR);
  peak = rclc_task_stack_peak(RCLC_TASK_CONTROL);
  CHECK(peak > 256u && peak < rclc_task_stack_size(RCLC_TASK_CONTROL));
  publish(1);
  wait_for_heard(1);
  port_sleep_ms(40); /* ten periods */
  CHECK(counters_of(RCLC_TASK_CONTROL).runs == before.runs);
  CHECK(counters_of(RCLC_TASK_CONTROL).missed == before.missed);
  CHECK(rclc_task_start(RCLC_TASK_CONTROL) == RCL_RET_OK);
  wait_for_runs(RCLC_TASK_CONTROL, SOME);
  CHECK(counters_of(RCLC_TASK_CONTROL).runs >= before.runs + (uint32_t)SOME);
}

/* What arrives meanwhile waits in the queue. */
static void check_events(void)
{
  const uint32_t before = heard_now();

  CHECK(rclc_task_stop(RCLC_TASK_WORKER) == RCL_RET_OK);
  for (int32_t i = 0; i < (int32_t)KEPT; ++i) {
    publish(i);
  }
  wait_for_runs(RCLC_TASK_CONTROL, 2);
  CHECK(heard_now() == before);
  CHECK(rclc_task_start(RCLC_TASK_WORKER) == RCL_RET_OK);
  wait_for_heard(before + (uint32_t)KEPT);
}

static void check_from_a_task(void)
{
  for (int turn = 0; turn < (int)TURNS; ++turn) {
    const uint32_t before = heard_now();

    set(&is_restarted, false);
    set(&restarts_worker, true);
    wait_for(&is_restarted);
    publish(turn);
    wait_for_heard(before + 1u);
  }
}

static void check_two_at_once(void)
{
  publish(STOPS_CONTROL);
  wait_for(&is_in_callback);
  set(&main_stops, true);
  CHECK(rclc_task_stop(RCLC_TASK_WORKER) == RCL_RET_OK);
  wait_for_runs(RCLC_TASK_CONTROL, 2);
}

int main(void)
{
  static std_msgs__msg__Int32 message;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_subscription_t subscription;
  rclc_executor_t executors[3];

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "count") == RCL_RET_OK);
  for (uint8_t i = 0; i < 3u; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    CHECK(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
    CHECK(rclc_task_set_executor(i, &executors[i], i == 0u ? on_release : NULL) == RCL_RET_OK);
  }
  CHECK(
    rclc_executor_add_subscription(&executors[1], &subscription, &message, on_message, ON_NEW_DATA) ==
    RCL_RET_OK);
  CHECK(rclc_task_stop(RCLC_TASK_CONTROL) == RCL_RET_ERROR); /* they do not run */
  CHECK(rclc_task_start(RCLC_TASK_CONTROL) == RCL_RET_ERROR);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  check_refusals();
  check_period();
  check_events();
  check_from_a_task();
  check_two_at_once();
  CHECK(rclc_tasks_stop() == RCL_RET_OK); /* one of them is stopped */
  CHECK(rclc_tasks_start() == RCL_RET_OK && rclc_tasks_stop() == RCL_RET_OK);
  return 0;
}
