/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What ends a wait in a task without a period, with an agent that sends no more than was asked for. Each part lasts
 * milliseconds; if nothing ended the waits, it would last many seconds. The application file is that of test_tasks.py.
 */
#include "unit.h"

#include <microros/port.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>

enum { WAIT_S = 20, MOST_MS = 4000, SAMPLES = 12, TURNS = 6, SOON_MS = 5 };

static rclc_support_t support;
static rcl_guard_condition_t begins;
static rcl_guard_condition_t ends;
static volatile bool has_begun;
static volatile bool has_ended;
static volatile bool has_read;
static int32_t samples;
static rcl_timer_t timer;
static volatile bool is_called[TURNS];
static volatile uint32_t calls;

/* Waits in a callback for something that is in no executor. */
static void on_begin(void)
{
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();

  CHECK(
    rcl_wait_set_init(&wait_set, 0, 1, 0, 0, 0, 0, &support.context, rcl_get_default_allocator()) ==
    RCL_RET_OK);
  CHECK(rcl_wait_set_add_guard_condition(&wait_set, &ends, NULL) == RCL_RET_OK);
  has_begun = true;
  CHECK(rcl_wait(&wait_set, (int64_t)WAIT_S * 1000000000) == RCL_RET_OK);
  CHECK(wait_set.guard_conditions[0] == &ends);
  has_ended = true;
  CHECK(rcl_wait_set_fini(&wait_set) == RCL_RET_OK);
}

static void on_sample(const void * message)
{
  const std_msgs__msg__Int32 * number = message;

  CHECK(number->data == samples);
  ++samples;
  has_read = samples == (int32_t)SAMPLES;
}

/* The task of the session has long begun to wait when this one takes a sample. */
static bool waits_first(rclc_executor_handle_t * handles, unsigned int size, void * object)
{
  const bool is_ready = rclc_executor_trigger_any(handles, size, object);

  if (is_ready) {
    port_sleep_ms(10);
  }
  return is_ready;
}

/* Fails if it takes much longer than a computer under load needs. */
static void wait_for(const volatile bool * what)
{
  const uint32_t start_ms = port_time_ms();

  while (!*what) {
    CHECK(port_time_ms() - start_ms < (uint32_t)MOST_MS);
    port_sleep_ms(1);
  }
}

static void check_callback(void)
{
  CHECK(rcl_trigger_guard_condition(&begins) == RCL_RET_OK);
  wait_for(&has_begun);
  port_sleep_ms(20); /* most likely it waits now */
  CHECK(rcl_trigger_guard_condition(&ends) == RCL_RET_OK);
  wait_for(&has_ended);
}

static void on_time(rcl_timer_t * which, int64_t last_ns)
{
  (void)last_ns;
  CHECK(rcl_timer_cancel(which) == RCL_RET_OK);
  if (calls < (uint32_t)TURNS) {
    is_called[calls] = true;
    ++calls;
  }
}

/* The task waits for a second with a timer of 100 s, and another one makes it due at once: several times, for it may just
 * have waited for that second. */
static void check_timer(void)
{
  const uint32_t start_ms = port_time_ms();
  int64_t before_ns;

  for (uint32_t turn = 0; turn < (uint32_t)TURNS; ++turn) {
    CHECK(rcl_timer_exchange_period(&timer, (int64_t)SOON_MS * 1000000, &before_ns) == RCL_RET_OK);
    CHECK(rcl_timer_reset(&timer) == RCL_RET_OK);
    wait_for(&is_called[turn]);
    port_sleep_ms(20); /* most likely it waits now */
  }
  CHECK(port_time_ms() - start_ms < (uint32_t)MOST_MS);
}

/* Their waits last a second, and begin with the start. */
static void check_stop(void)
{
  const uint32_t start_ms = port_time_ms();

  for (uint32_t turn = 0; turn < (uint32_t)TURNS; ++turn) {
    CHECK(rclc_tasks_start() == RCL_RET_OK);
    port_sleep_ms(turn % 2u * 20u); /* they wait already, or are about to */
    CHECK(rclc_tasks_stop() == RCL_RET_OK);
  }
  CHECK(port_time_ms() - start_ms < (uint32_t)MOST_MS);
}

int main(void)
{
  static std_msgs__msg__Int32 sample;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_subscription_t subscription;
  rclc_executor_t executors[2];

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "target") == RCL_RET_OK);
  begins = rcl_get_zero_initialized_guard_condition();
  ends = rcl_get_zero_initialized_guard_condition();
  CHECK(
    rcl_guard_condition_init(&begins, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  CHECK(
    rcl_guard_condition_init(&ends, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  for (uint8_t i = 0; i < 2u; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    CHECK(rclc_executor_init(&executors[i], &support.context, 2, &allocator) == RCL_RET_OK);
    CHECK(rclc_task_set_executor(i, &executors[i], NULL) == RCL_RET_OK);
  }
  CHECK(
    rclc_executor_add_subscription(&executors[0], &subscription, &sample, on_sample, ON_NEW_DATA) ==
    RCL_RET_OK);
  CHECK(rclc_executor_set_trigger(&executors[0], waits_first, NULL) == RCL_RET_OK);
  timer = rcl_get_zero_initialized_timer();
  CHECK(rclc_timer_init_default2(&timer, &support, (uint64_t)100 * 1000000000u, on_time, true) == RCL_RET_OK);
  CHECK(rclc_executor_add_timer(&executors[1], &timer) == RCL_RET_OK);
  CHECK(rclc_executor_add_guard_condition(&executors[1], &begins, on_begin) == RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  wait_for(&has_read);
  check_callback();
  check_timer();
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
  check_stop();
  return 0;
}
