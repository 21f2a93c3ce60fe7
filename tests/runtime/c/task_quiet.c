/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wake-ups of tasks that have nothing to do, as the system counts them: task_quiet MS. Prints how often threads of the process
 * went to sleep within that time. The application file is that of test_task_wakes.py; its agent sends a sample before and
 * after.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit.h"
#include "unit_heard.h"
#include "unit_sleeps.h"

#include <microros/port.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

enum { EXECUTORS = 3, SETTLED_MS = 1500 };

static rcl_publisher_t publisher;
/* The agent answers each message with a sample. */
static void exchange(void)
{
  const std_msgs__msg__Int32 message = {.data = 1};
  const uint32_t before = heard_now();

  CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
  while (heard_now() == before) {
    port_sleep_ms(1);
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
  rclc_executor_t executors[EXECUTORS];
  unsigned long before;

  CHECK(count == 2);
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "target") == RCL_RET_OK);
  for (uint8_t i = 0; i < (uint8_t)EXECUTORS; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    CHECK(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
    CHECK(rclc_task_set_executor(i, &executors[i], NULL) == RCL_RET_OK);
  }
  CHECK(
    rclc_executor_add_subscription(&executors[0], &subscription, &sample, on_sample, ON_NEW_DATA) ==
    RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  exchange();
  port_sleep_ms(SETTLED_MS);
  before = sleeps();
  port_sleep_ms((uint32_t)strtoul(arguments[1], NULL, 10));
  (void)printf("%lu\n", sleeps() - before);
  exchange();
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
  return 0;
}
