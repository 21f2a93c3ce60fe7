/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A line without room: task_full MS. Publishes until the line and the streams are full, and prints how often threads of the
 * process go to sleep within that time. Then it waits until a message is accepted again. The application file is that of
 * test_task_wakes.py, which stops reading meanwhile.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit.h"
#include "unit_sleeps.h"

#include <microros/port.h>
#include <microros/tasks.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>

enum { FULL_MS = 500 };

static rcl_publisher_t publishers[2];

static bool publish(size_t which)
{
  const std_msgs__msg__Int32 message = {.data = 1};
  const bool is_accepted = rcl_publish(&publishers[which], &message, NULL) == RCL_RET_OK;

  rcl_reset_error();
  return is_accepted;
}

/* Both streams refuse for a while. */
static void fill(void)
{
  uint32_t since_ms = port_time_ms();

  while (port_time_ms() - since_ms < (uint32_t)FULL_MS) {
    if (publish(0) || publish(1)) {
      since_ms = port_time_ms();
    } else {
      port_sleep_ms(1);
    }
  }
}

int main(int count, char * arguments[])
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  unsigned long before;

  CHECK(count == 2);
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publishers[0], &node, type, "kept") == RCL_RET_OK);
  CHECK(rclc_publisher_init_best_effort(&publishers[1], &node, type, "fast") == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(rclc_task_set_executor(RCLC_TASK_IDLE, &executor, NULL) == RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  fill();
  before = sleeps();
  port_sleep_ms((uint32_t)strtoul(arguments[1], NULL, 10));
  (void)printf("%lu\n", sleeps() - before);
  CHECK(fflush(stdout) == 0);
  while (!publish(0) || !publish(1)) {
    port_sleep_ms(1);
  }
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
  return 0;
}
