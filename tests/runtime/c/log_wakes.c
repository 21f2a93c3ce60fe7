/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lines that threads log while nothing else happens: log_wakes MS ROUNDS. Prints how often threads of the process went to sleep
 * within MS without any line. Then in each of ROUNDS, WRITERS threads log a line at once, and the agent of test_task_wakes.py
 * sends a sample when it has them all: a wait that does not end for one of them ends the program.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit.h"
#include "unit_heard.h"
#include "unit_sleeps.h"

#include <microros/port.h>
#include <microros_config.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rcutils/logging_macros.h>
#include <std_msgs/msg/int32.h>

#include <pthread.h>
#include <time.h>

#ifdef MICROROS_TASKS
#include <microros/tasks.h>
#endif

enum { WRITERS = 4, SETTLED_MS = 2500, MS_AT_MOST = 20000, PHASES = 7 };

static rclc_executor_t executor;
static pthread_barrier_t begins;
static uint32_t rounds;

#ifndef MICROROS_TASKS
static void * spin(void * argument)
{
  (void)rclc_executor_spin(&executor);
  return argument;
}
#endif

/* So that lines come at all moments of the session's task: before its wait, in it, and after it. */
static void rest(uint32_t round)
{
  const struct timespec time = {0, (long)(round % (uint32_t)PHASES) * 150000L};

  (void)nanosleep(&time, NULL);
}

static void * write_lines(void * argument)
{
  const unsigned number = *(const unsigned *)argument;

  for (uint32_t i = 0; i < rounds; ++i) {
    (void)pthread_barrier_wait(&begins);
    RCUTILS_LOG_WARN_NAMED("writer", "writer %u round %u", number, (unsigned)i);
  }
  return NULL;
}

static void await(uint32_t samples)
{
  for (uint32_t i = 0; i < 2u * (uint32_t)MS_AT_MOST && heard_now() < samples; ++i) {
    const struct timespec half = {0, 500000L};

    (void)nanosleep(&half, NULL);
  }
  CHECK(heard_now() == samples);
}

static void run_rounds(void)
{
  unsigned numbers[WRITERS];
  pthread_t threads[WRITERS];

  CHECK(pthread_barrier_init(&begins, NULL, (unsigned)WRITERS + 1u) == 0);
  for (unsigned i = 0; i < (unsigned)WRITERS; ++i) {
    numbers[i] = i;
    CHECK(pthread_create(&threads[i], NULL, write_lines, &numbers[i]) == 0);
  }
  for (uint32_t i = 0; i < rounds; ++i) {
    rest(i);
    (void)pthread_barrier_wait(&begins);
    await(i + 1u);
  }
  for (unsigned i = 0; i < (unsigned)WRITERS; ++i) {
    CHECK(pthread_join(threads[i], NULL) == 0);
  }
}

int main(int count, char * arguments[])
{
  static std_msgs__msg__Int32 sample;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_subscription_t subscription;
  unsigned long before;

  CHECK(count == 3);
  rounds = (uint32_t)strtoul(arguments[2], NULL, 10);
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "target") == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &sample, on_sample, ON_NEW_DATA) == RCL_RET_OK);
#ifdef MICROROS_TASKS
  CHECK(rclc_task_set_executor(0, &executor, NULL) == RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
#else
  pthread_t thread;

  CHECK(pthread_create(&thread, NULL, spin, NULL) == 0);
#endif
  port_sleep_ms(SETTLED_MS);
  before = sleeps();
  port_sleep_ms((uint32_t)strtoul(arguments[1], NULL, 10));
  (void)printf("%lu\n", sleeps() - before);
  run_rounds();
#ifdef MICROROS_TASKS
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
#else
  CHECK(rcl_shutdown(&support.context) == RCL_RET_OK);
  CHECK(pthread_join(thread, NULL) == 0);
#endif
  return 0;
}
