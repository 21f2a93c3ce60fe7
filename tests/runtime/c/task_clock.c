/* SPDX-License-Identifier: Apache-2.0 */
/*
 * ROS time that the task of the session receives and every task reads, while another task sets timers, adds jump callbacks
 * and takes clocks. No callback of a jump is called with the lock. The application file is that of test_task_clock.py.
 */
#include "unit.h"

#include <microros/port.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc/timer.h>

#include <pthread.h>
#include <stdbool.h>

enum { TURNS = 60, MOST_MS = 20000 };

static const int64_t ms = 1000000;

static rcl_allocator_t allocator;
static rclc_support_t support;
static rcl_timer_t timers[2];
static uint32_t taken; /* these four: the lock of the port guards them */
static uint32_t jumps;
static uint32_t calls;
static bool is_over;

static uint32_t get(const uint32_t * count)
{
  uint32_t value;

  port_lock();
  value = *count;
  port_unlock();
  return value;
}

static void add(uint32_t * count)
{
  port_lock();
  ++*count;
  port_unlock();
}

/* Takes the lock whenever it can. */
static void * take(void * argument)
{
  bool ends = false;

  (void)argument;
  while (!ends) {
    port_lock();
    ++taken;
    ends = is_over;
    port_unlock();
    port_sleep_ms(1);
  }
  return NULL;
}

/* Another task can take the lock meanwhile. */
static void on_jump(const rcl_time_jump_t * jump, bool before_jump, void * user_data)
{
  const uint32_t start_ms = port_time_ms();
  const uint32_t before = get(&taken);

  CHECK(jump->clock_change == RCL_ROS_TIME_NO_CHANGE && user_data == &jumps);
  (void)before_jump;
  while (get(&taken) == before) {
    CHECK(port_time_ms() - start_ms < (uint32_t)MOST_MS);
    port_sleep_ms(1);
  }
  add(&jumps);
}

static void on_timer(rcl_timer_t * timer, int64_t last_ns)
{
  int64_t left_ns;

  (void)last_ns;
  CHECK(rcl_timer_get_time_until_next_call(timer, &left_ns) != RCL_RET_ERROR);
  add(&calls);
}

static void on_reset(const void * user_data, size_t resets)
{
  CHECK(user_data == timers && resets != 0u);
}

static void set_timer(rcl_timer_t * timer, int turn)
{
  rcl_timer_callback_t callback = rcl_timer_get_callback(timer);
  int64_t value;
  bool is_ready;

  CHECK(callback == on_timer && rcl_timer_exchange_callback(timer, callback) == callback);
  CHECK(rcl_timer_exchange_period(timer, (int64_t)(1 + turn % 3) * ms, &value) == RCL_RET_OK);
  CHECK(rcl_timer_get_period(timer, &value) == RCL_RET_OK);
  CHECK(rcl_timer_get_time_since_last_call(timer, &value) == RCL_RET_OK);
  CHECK(rcl_timer_is_ready(timer, &is_ready) == RCL_RET_OK);
  CHECK(rcl_timer_set_on_reset_callback(timer, turn % 2 == 0 ? on_reset : NULL, timers) == RCL_RET_OK);
  if (turn % 4 == 0) {
    CHECK(rcl_timer_cancel(timer) == RCL_RET_OK);
    CHECK(rcl_timer_is_canceled(timer, &is_ready) == RCL_RET_OK);
  }
  CHECK(rcl_timer_reset(timer) == RCL_RET_OK);
  CHECK(rcl_timer_get_guard_condition(timer) != NULL);
}

/* A clock and a timer of this task, while the others read theirs. */
static void take_clock(void)
{
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  rcl_time_point_value_t now;
  rcl_clock_t clock;
  bool is_enabled;

  CHECK(rcl_ros_clock_init(&clock, &allocator) == RCL_RET_OK);
  CHECK(rcl_timer_init2(&timer, &clock, &support.context, 7 * ms, on_timer, allocator, true) == RCL_RET_OK);
  CHECK(rcl_clock_get_now(&clock, &now) == RCL_RET_OK);
  CHECK(rcl_disable_ros_time_override(&clock) == RCL_RET_OK);
  CHECK(rcl_is_enabled_ros_time_override(&clock, &is_enabled) == RCL_RET_OK);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK && rcl_ros_clock_fini(&clock) == RCL_RET_OK);
}

static void change_all(void)
{
  const rcl_jump_threshold_t threshold = {true, {1}, {-1}};
  const uint32_t start_ms = port_time_ms();

  for (int turn = 0; turn < TURNS || get(&calls) < TURNS || get(&jumps) < TURNS; ++turn) {
    rcl_time_point_value_t now;

    CHECK(port_time_ms() - start_ms < 3u * (uint32_t)MOST_MS);
    CHECK(rcl_clock_add_jump_callback(&support.clock, threshold, on_jump, &jumps) == RCL_RET_OK);
    for (int i = 0; i < 2; ++i) {
      set_timer(&timers[i], turn);
    }
    CHECK(rcl_clock_get_now(&support.clock, &now) == RCL_RET_OK);
    take_clock();
    port_sleep_ms(1);
    CHECK(rcl_clock_remove_jump_callback(&support.clock, on_jump, &jumps) == RCL_RET_OK);
  }
}

int main(void)
{
  rcl_node_t node = rcl_get_zero_initialized_node();
  rclc_executor_t executors[2];
  pthread_t taker;

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  for (uint8_t i = 0; i < 2u; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    timers[i] = rcl_get_zero_initialized_timer();
    CHECK(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
    CHECK(rclc_timer_init_default2(&timers[i], &support, (uint64_t)ms, on_timer, true) == RCL_RET_OK);
    CHECK(rclc_executor_add_timer(&executors[i], &timers[i]) == RCL_RET_OK);
    CHECK(rclc_task_set_executor(i, &executors[i], NULL) == RCL_RET_OK);
  }
  CHECK(pthread_create(&taker, NULL, take, NULL) == 0);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  change_all();
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
  port_lock();
  is_over = true;
  port_unlock();
  CHECK(pthread_join(taker, NULL) == 0);
  return 0;
}
