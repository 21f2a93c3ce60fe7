/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Work at 1 kHz beside a saturated reliable stream: with BENCH_TASKS in a task above the one that publishes, else as the timer
 * of an executor in the loop that publishes. Prints by how many microseconds the time between two runs differed from a
 * millisecond: 50 %, 99 %, the most; messages that were published; and whether the system has priorities. Define SAMPLES for
 * another number of runs.
 */
#define _GNU_SOURCE
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#ifdef BENCH_TASKS
#include <microros/port.h>
#include <microros/tasks.h>
#endif

#ifndef SAMPLES
#define SAMPLES 5000
#endif

enum { PERIOD_US = 1000, WARM_UP = 200 };

static rcl_publisher_t publisher;
static volatile uint32_t samples; /* a task writes it, main reads it */
static uint32_t deviations_us[SAMPLES];
static volatile uint32_t published;

static int64_t now_us(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static void sample(void)
{
  static int64_t before_us;
  static uint32_t warm;
  const int64_t time_us = now_us();
  const int64_t deviation_us = time_us - before_us - PERIOD_US;

  before_us = time_us;
  if (warm < WARM_UP) {
    ++warm;
  } else if (samples < SAMPLES) {
    deviations_us[samples] = (uint32_t)llabs(deviation_us);
    ++samples;
  }
}

static void publish(void)
{
  static std_msgs__msg__Int32 message;

  ++message.data;
  if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
    ++published;
  }
}

static int compare(const void * first, const void * second)
{
  const uint32_t a = *(const uint32_t *)first;
  const uint32_t b = *(const uint32_t *)second;

  return (a > b) - (a < b);
}

static void check(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    exit(1);
  }
}

#ifdef BENCH_TASKS
static void on_control(uint8_t task)
{
  (void)task;
  sample();
}

static void on_load(uint8_t task)
{
  (void)task;
  while (samples < SAMPLES) {
    publish();
  }
}

static int work(rclc_executor_t * executors)
{
  int has_priorities;

  check(rclc_task_set_executor(RCLC_TASK_CONTROL, &executors[0], on_control));
  check(rclc_task_set_executor(RCLC_TASK_LOAD, &executors[1], on_load));
  check(rclc_tasks_start());
  has_priorities = rclc_tasks_are_prioritized() ? 1 : 0;
  while (samples < SAMPLES) {
    port_sleep_ms(100);
  }
  check(rclc_tasks_stop());
  return has_priorities;
}
#else
static void on_timer(rcl_timer_t * timer, int64_t last_call_time)
{
  (void)timer;
  (void)last_call_time;
  sample();
}

static int work(rclc_executor_t * executors)
{
  while (samples < SAMPLES) {
    publish();
    check(rclc_executor_spin_some(&executors[0], 0));
  }
  return 0;
}
#endif

int main(void)
{
  static rclc_executor_t executors[2];
  static rclc_support_t support;
  static rcl_node_t node;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  int has_priorities;

  check(rclc_support_init(&support, 0, NULL, &allocator));
  check(rclc_node_init_default(&node, "device", "", &support));
  check(rclc_publisher_init_default(
    &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "load"));
  check(rclc_executor_init(&executors[0], &support.context, 1, &allocator));
#ifdef BENCH_TASKS
  check(rclc_executor_init(&executors[1], &support.context, 1, &allocator));
#else
  static rcl_timer_t timer;

  check(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(1), on_timer, true));
  check(rclc_executor_add_timer(&executors[0], &timer));
#endif
  has_priorities = work(executors);
  qsort(deviations_us, SAMPLES, sizeof(deviations_us[0]), compare);
  (void)printf(
    "%u %u %u %u %d\n", deviations_us[SAMPLES / 2], deviations_us[SAMPLES * 99 / 100],
    deviations_us[SAMPLES - 1], published, has_priorities);
  return 0;
}
