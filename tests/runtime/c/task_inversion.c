/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Priority inversion: task_inversion inherits|plain|raised. The low task holds the library's lock; the high one publishes
 * and so waits for it; the middle one takes the processor, the only one of the program. Prints how long the publish took.
 * With `plain` the lock of the port has no priority inheritance, and the high task waits for the middle one as well; with
 * `raised` it has none, either, but the low task gives itself the highest priority before. Status 77: the process may not
 * use priorities. The application file is that of test_task_inversion.py.
 */
#define _GNU_SOURCE
#include "unit.h"

#include <dlfcn.h>
#include <microros/port.h>
#include <microros/tasks.h>
#include <pthread.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <sched.h>
#include <semaphore.h>
#include <std_msgs/msg/int32.h>

#include <stdio.h>
#include <string.h>
#include <time.h>

enum { EXECUTORS = 3, SKIPPED = 77, HOLD_US = 15000, SPIN_US = 250000, US_PER_S = 1000000, NS_PER_US = 1000 };

typedef int (*set_protocol_t)(pthread_mutexattr_t * kind, int protocol);

static bool is_plain;
static bool is_raised;
static rcl_publisher_t publisher;
static sem_t high_may;
static sem_t middle_may;
static sem_t all_is_done;
static uint64_t waited_us;

/* In place of that of the C library: the port asks for inheritance, and does not get it. */
int pthread_mutexattr_setprotocol(pthread_mutexattr_t * kind, int protocol)
{
  set_protocol_t real;
  void * found = dlsym(RTLD_NEXT, "pthread_mutexattr_setprotocol");

  CHECK(found != NULL);
  (void)memcpy(&real, &found, sizeof(real));
  return is_plain ? 0 : real(kind, protocol);
}

static uint64_t microseconds(clockid_t clock)
{
  struct timespec now;

  CHECK(clock_gettime(clock, &now) == 0);
  return (uint64_t)now.tv_sec * US_PER_S + (uint64_t)now.tv_nsec / NS_PER_US;
}

/* Time of the processor: what the task does not run does not count. */
static void spin(uint64_t time_us)
{
  const uint64_t end_us = microseconds(CLOCK_THREAD_CPUTIME_ID) + time_us;

  while (microseconds(CLOCK_THREAD_CPUTIME_ID) < end_us) {
  }
}

static void take(sem_t * semaphore)
{
  while (sem_wait(semaphore) != 0) {
  }
}

static void on_high(uint8_t task)
{
  const std_msgs__msg__Int32 message = {.data = task};
  uint64_t begin_us;

  take(&high_may);
  begin_us = microseconds(CLOCK_MONOTONIC);
  CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
  waited_us = microseconds(CLOCK_MONOTONIC) - begin_us;
  CHECK(sem_post(&all_is_done) == 0);
}

static void on_middle(uint8_t task)
{
  (void)task;
  take(&middle_may);
  spin(SPIN_US);
}

/* The high task runs at once, up to the lock; the middle one as soon as no task above it does. */
static void on_low(uint8_t task)
{
  if (is_raised) {
    CHECK(rclc_task_set_priority(task, 1) == RCL_RET_OK);
  }
  port_lock();
  CHECK(sem_post(&high_may) == 0);
  CHECK(sem_post(&middle_may) == 0);
  spin(HOLD_US);
  port_unlock();
}

static void use_one_processor(void)
{
  cpu_set_t all;
  cpu_set_t one;

  CHECK(sched_getaffinity(0, sizeof(all), &all) == 0);
  CPU_ZERO(&one);
  for (int i = 0; CPU_COUNT(&one) == 0; ++i) {
    if (CPU_ISSET(i, &all)) {
      CPU_SET(i, &one);
    }
  }
  CHECK(sched_setaffinity(0, sizeof(one), &one) == 0);
}

int main(int count, char * arguments[])
{
  static const rclc_task_callback_t callbacks[EXECUTORS] = {on_high, on_middle, on_low};
  static const uint8_t tasks[EXECUTORS] = {RCLC_TASK_HIGH, RCLC_TASK_MIDDLE, RCLC_TASK_LOW};
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rclc_executor_t executors[EXECUTORS];

  CHECK(count == 2);
  is_raised = strcmp(arguments[1], "raised") == 0;
  is_plain = is_raised || strcmp(arguments[1], "plain") == 0;
  use_one_processor();
  CHECK(
    sem_init(&high_may, 0, 0) == 0 && sem_init(&middle_may, 0, 0) == 0 && sem_init(&all_is_done, 0, 0) == 0);
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  for (uint8_t i = 0; i < (uint8_t)EXECUTORS; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    CHECK(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
    CHECK(rclc_task_set_executor(tasks[i], &executors[i], callbacks[i]) == RCL_RET_OK);
  }
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  if (!rclc_tasks_are_prioritized()) {
    return SKIPPED;
  }
  take(&all_is_done);
  (void)printf("%lu\n", (unsigned long)waited_us);
  return 0;
}
