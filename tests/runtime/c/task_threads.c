/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tasks as threads: one with a period publishes inside the image, what arrives wakes the task whose executor has the
 * subscription, and no other one. The application file is that of test_tasks.py.
 */
#include "unit.h"

#include <microros/port.h>
#include <microros/port_tasks.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdio.h>

enum { MESSAGES = 50 };

static rcl_publisher_t publisher;
static int32_t sent;
static int32_t heard; /* the lock of the port guards it */

static void on_release(uint8_t task)
{
  const std_msgs__msg__Int32 message = {.data = sent};

  CHECK(task == RCLC_TASK_CONTROL && port_task_self() == task);
  if (sent < MESSAGES) {
    CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
    ++sent;
  }
}

static void on_message(const void * message)
{
  const std_msgs__msg__Int32 * number = message;

  CHECK(port_task_self() == RCLC_TASK_WORKER);
  port_lock();
  CHECK(number->data == heard);
  ++heard;
  port_unlock();
}

static void on_other(const void * message)
{
  (void)message;
  CHECK(false);
}

static bool all_heard(void)
{
  bool result;

  port_lock();
  result = heard == MESSAGES;
  port_unlock();
  return result;
}

static rclc_task_counters_t counters_of(uint8_t task)
{
  rclc_task_counters_t counters;

  CHECK(rclc_task_get_counters(task, &counters) == RCL_RET_OK);
  return counters;
}

int main(void)
{
  static std_msgs__msg__Int32 message, other;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_subscription_t subscriptions[2];
  rclc_executor_t executors[3];

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscriptions[0], &node, type, "count") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscriptions[1], &node, type, "other") == RCL_RET_OK);
  for (uint8_t i = 0; i < 3u; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    CHECK(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
  }
  CHECK(
    rclc_executor_add_subscription(&executors[1], &subscriptions[0], &message, on_message, ON_NEW_DATA) ==
    RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executors[2], &subscriptions[1], &other, on_other, ON_NEW_DATA) ==
    RCL_RET_OK);
  CHECK(rclc_task_set_executor(RCLC_TASK_CONTROL, &executors[0], on_release) == RCL_RET_OK);
  CHECK(rclc_task_set_executor(RCLC_TASK_WORKER, &executors[1], NULL) == RCL_RET_OK);
  CHECK(rclc_task_set_executor(RCLC_TASK_IDLE, &executors[2], NULL) == RCL_RET_OK);
  for (int turn = 0; turn < 2; ++turn) { /* tasks that were stopped start again */
    CHECK(rclc_tasks_start() == RCL_RET_OK);
    CHECK(port_task_self() == PORT_TASK_NONE);
    while (!all_heard()) {
      port_sleep_ms(1);
    }
    CHECK(counters_of(RCLC_TASK_CONTROL).runs >= (uint32_t)(turn == 0 ? MESSAGES : 1));
    CHECK(rclc_tasks_stop() == RCL_RET_OK);
    CHECK(counters_of(RCLC_TASK_WORKER).runs == (uint32_t)(turn == 0 ? MESSAGES : 0));
    CHECK(counters_of(RCLC_TASK_IDLE).runs == 0u);
    for (uint8_t task = 0; task < 4u; ++task) {
      const uint32_t peak = rclc_task_stack_peak(task);

      CHECK(peak > 256u && peak < rclc_task_stack_size(task));
    }
  }
  (void)printf("prioritized: %d\n", rclc_tasks_are_prioritized() ? 1 : 0);
  return 0;
}
