/* SPDX-License-Identifier: Apache-2.0 */
/* Publishers in four threads, two of which share one, an executor in a fifth, questions to the session in a sixth. */
#define _POSIX_C_SOURCE 200809L
#include "types.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { PUBLISHERS = 3, TASKS = 4, VALUES = 150, TASK_VALUES = 100000, RECEIVED = 300 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publishers[PUBLISHERS];
static rcl_subscription_t subscription;
static rclc_executor_t executor;
static std_msgs__msg__Int32 taken;
static int32_t expected;
static int tasks[TASKS] = {0, 1, 2, 3};

static void check(bool good, const char * what)
{
  if (!good) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    abort();
  }
}

static void on_value(const void * message)
{
  const std_msgs__msg__Int32 * value = message;

  check(value->data == expected, "a sample is missing, doubled or out of order");
  ++expected;
}

static void * publish(void * argument)
{
  const int task = *(const int *)argument;
  rcl_publisher_t * publisher = &publishers[task < PUBLISHERS ? task : 0];

  for (int32_t i = 0; i < VALUES; ++i) {
    std_msgs__msg__Int32 message;

    message.data = (int32_t)task * TASK_VALUES + i;
    check(rcl_publish(publisher, &message, NULL) == RCL_RET_OK, "publish");
    if (i % 16 == 0) {
      check(rcl_publish(publisher, NULL, NULL) != RCL_RET_OK, "NULL");
      (void)rcl_get_error_string();
      rcl_reset_error();
    }
  }
  return NULL;
}

static void * spin(void * argument)
{
  (void)argument;
  while (expected < RECEIVED) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(1000));
  }
  return NULL;
}

static void * ask(void * argument)
{
  rmw_context_t * context = rcl_context_get_rmw_context(&support.context);
  rmw_uros_statistics_t counted;

  (void)argument;
  for (int i = 0; i < 20; ++i) {
    check(rmw_uros_ping_agent(5000, 1) == RMW_RET_OK, "ping");
    check(rmw_uros_get_statistics(context, &counted) == RMW_RET_OK, "statistics");
    check(rmw_uros_is_connected(context), "connected");
  }
  return NULL;
}

static void open_all(rcl_allocator_t * allocator)
{
  static const char * const topics[PUBLISHERS] = {"a", "b", "c"};
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  check(rclc_support_init(&support, 0, NULL, allocator) == RCL_RET_OK, "init");
  check(rclc_node_init_default(&node, "threads", "", &support) == RCL_RET_OK, "node");
  for (int i = 0; i < PUBLISHERS; ++i) {
    check(rclc_publisher_init_default(&publishers[i], &node, type, topics[i]) == RCL_RET_OK, "publisher");
  }
  check(rclc_subscription_init_default(&subscription, &node, type, "in") == RCL_RET_OK, "subscription");
  executor = rclc_executor_get_zero_initialized_executor();
  check(rclc_executor_init(&executor, &support.context, 1, allocator) == RCL_RET_OK, "executor");
  check(
    rclc_executor_add_subscription(&executor, &subscription, &taken, on_value, ON_NEW_DATA) == RCL_RET_OK,
    "add");
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  pthread_t threads[TASKS + 3];

  open_all(&allocator);
  for (int i = 0; i < TASKS; ++i) {
    check(pthread_create(&threads[i], NULL, publish, &tasks[i]) == 0, "thread");
  }
  check(pthread_create(&threads[TASKS], NULL, spin, NULL) == 0, "thread");
  check(pthread_create(&threads[TASKS + 1], NULL, ask, NULL) == 0, "thread");
  check(pthread_create(&threads[TASKS + 2], NULL, ask, NULL) == 0, "thread");
  for (int i = 0; i < TASKS + 3; ++i) {
    check(pthread_join(threads[i], NULL) == 0, "join");
  }
  check(rmw_uros_flush(rcl_context_get_rmw_context(&support.context), 20000) == RMW_RET_OK, "flush");
  check(rcl_node_fini(&node) == RCL_RET_OK && rclc_support_fini(&support) == RCL_RET_OK, "fini");
  return 0;
}
