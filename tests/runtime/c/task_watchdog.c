/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tasks as threads with a watchdog, which is fed also without the agent, and not while a callback is stuck. The
 * application file is that of test_tasks_watchdog.py, which ends the agent when it has seen some messages.
 */
#include "unit.h"

#include <microros/port.h>
#include <microros/port_tasks.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

enum { TASKS = 2, SOME = 10, LIMIT_US = 150000, LONGEST_REST_MS = 1300 };

static rcl_publisher_t publisher;
static uint32_t feeds; /* the lock of the port guards these */
static bool holds[TASKS];
static bool is_held[TASKS];

void port_watchdog_feed(void)
{
  ++feeds;
}

static uint32_t fed(void)
{
  uint32_t count;

  port_lock();
  count = feeds;
  port_unlock();
  return count;
}

static void hold(uint8_t task, bool on)
{
  port_lock();
  holds[task] = on;
  port_unlock();
}

static bool task_is_held(uint8_t task)
{
  bool result;

  port_lock();
  result = is_held[task];
  port_unlock();
  return result;
}

/* A callback that is stuck as long as the test says. */
static void stay(uint8_t task)
{
  bool stays = true;

  while (stays) {
    port_lock();
    stays = holds[task];
    is_held[task] = stays;
    port_unlock();
    if (stays) {
      port_sleep_ms(1);
    }
  }
}

static void on_release(uint8_t task)
{
  const std_msgs__msg__Int32 message = {.data = 1};

  (void)rcl_publish(&publisher, &message, NULL); /* without the agent the stream is full */
  stay(task);
}

static void on_beat(rcl_timer_t * timer, int64_t since_last_ns)
{
  (void)timer;
  (void)since_last_ns;
  stay(RCLC_TASK_WORKER);
}

static void wait_for_feeds(uint32_t count)
{
  const uint32_t before = fed();

  while (fed() - before < count) {
    port_sleep_ms(1);
  }
}

static uint32_t runs_of(uint8_t task)
{
  rclc_task_counters_t counters;

  CHECK(rclc_task_get_counters(task, &counters) == RCL_RET_OK);
  return counters.runs;
}

static void wait_for_runs(uint8_t task)
{
  const uint32_t before = runs_of(task);

  while (runs_of(task) - before < (uint32_t)SOME) {
    port_sleep_ms(1);
  }
}

/* The other tasks go on, and do not feed it. */
static void test_stuck(uint8_t task, uint8_t other)
{
  uint32_t since_us;
  uint32_t before;

  hold(task, true);
  while (!task_is_held(task)) {
    port_sleep_ms(1);
  }
  since_us = port_task_time_us();
  while (port_task_time_us() - since_us < (uint32_t)LIMIT_US) {
    port_sleep_ms(1);
  }
  before = fed();
  wait_for_runs(other);
  CHECK(fed() == before);
  hold(task, false);
  wait_for_feeds(SOME);
}

/* A task that is stopped is not late, however long; when it runs again, it can be. */
static void test_restart(void)
{
  CHECK(rclc_task_stop(RCLC_TASK_WORKER) == RCL_RET_OK);
  port_sleep_ms(LONGEST_REST_MS);
  wait_for_feeds(SOME);
  CHECK(rclc_task_start(RCLC_TASK_WORKER) == RCL_RET_OK);
  wait_for_feeds(SOME);
  test_stuck(RCLC_TASK_WORKER, RCLC_TASK_CONTROL);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  rclc_executor_t executors[TASKS];

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") == RCL_RET_OK);
  CHECK(rclc_timer_init_default2(&timer, &support, 20000000u, on_beat, true) == RCL_RET_OK);
  for (uint8_t i = 0; i < (uint8_t)TASKS; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    CHECK(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
  }
  CHECK(rclc_executor_add_timer(&executors[1], &timer) == RCL_RET_OK);
  CHECK(rclc_task_set_executor(RCLC_TASK_CONTROL, &executors[0], on_release) == RCL_RET_OK);
  CHECK(rclc_task_set_executor(RCLC_TASK_WORKER, &executors[1], NULL) == RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  wait_for_feeds(SOME);
  while (rmw_uros_is_connected(rcl_context_get_rmw_context(&support.context))) {
    port_sleep_ms(1);
  }
  wait_for_feeds(SOME); /* the agent is gone */
  test_stuck(RCLC_TASK_CONTROL, RCLC_TASK_WORKER);
  test_stuck(RCLC_TASK_WORKER, RCLC_TASK_CONTROL);
  test_restart();
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
  return 0;
}
