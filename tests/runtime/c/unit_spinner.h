/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node `device` with a subscription of `target`, for programs of several threads: its executor runs in the task 0, or in a thread
 * where the application file has no tasks. Samples are counted by unit_heard.h.
 */
#ifndef UNIT_SPINNER_H
#define UNIT_SPINNER_H

#include "unit.h"
#include "unit_heard.h"
#include "unit_sleeps.h"

#include <microros/port.h>
#include <microros_config.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <pthread.h>

#ifdef MICROROS_TASKS
#include <microros/tasks.h>
#endif

enum { SPINNER_SETTLED_MS = 2500 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;

#ifndef MICROROS_TASKS
static pthread_t spinner;

static void * spinner_run(void * argument)
{
  (void)rclc_executor_spin(&executor);
  return argument;
}
#endif

static void spinner_open(void)
{
  static std_msgs__msg__Int32 sample;
  static rcl_subscription_t subscription;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "target") == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &sample, on_sample, ON_NEW_DATA) == RCL_RET_OK);
}

/* Returns when its wait has begun, and is long. */
static void spinner_start(void)
{
#ifdef MICROROS_TASKS
  CHECK(rclc_task_set_executor(0, &executor, NULL) == RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
#else
  CHECK(pthread_create(&spinner, NULL, spinner_run, NULL) == 0);
#endif
  port_sleep_ms(SPINNER_SETTLED_MS);
}

/* Returns how often threads of the process go to sleep within that time; the calling one does once. */
static unsigned long spinner_sleeps(uint32_t ms)
{
  const unsigned long before = sleeps();

  port_sleep_ms(ms);
  return sleeps() - before;
}

static void spinner_stop(void)
{
#ifdef MICROROS_TASKS
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
#else
  CHECK(rcl_shutdown(&support.context) == RCL_RET_OK);
  CHECK(pthread_join(spinner, NULL) == 0); /* the executor notices that its context has ended */
#endif
}

#endif /* UNIT_SPINNER_H */
