/* SPDX-License-Identifier: Apache-2.0 */
/* The image of CPU 1 on QEMU's mps2-an521, started by that of shared_first.c: sends back on /pong what it hears on /ping. */
#include "shared_core.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

static rcl_publisher_t publisher;

static void on_number(const void * message)
{
  (void)rcl_publish(&publisher, message, NULL); /* a full ring: the first image sends the number again */
}

int main(void)
{
  static rclc_support_t support;
  static rcl_node_t node;
  static rcl_subscription_t subscription;
  static rclc_executor_t executor;
  static std_msgs__msg__Int32 received;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
    rclc_node_init_default(&node, "second", "", &support) == RCL_RET_OK &&
    rclc_publisher_init_default(&publisher, &node, type, "pong") == RCL_RET_OK &&
    rclc_subscription_init_default(&subscription, &node, type, "ping") == RCL_RET_OK &&
    rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK &&
    rclc_executor_add_subscription(&executor, &subscription, &received, on_number, ON_NEW_DATA) ==
      RCL_RET_OK) {
    (void)rclc_executor_spin(&executor);
  }
  for (;;) {
  }
}
