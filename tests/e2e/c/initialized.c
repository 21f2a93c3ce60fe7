/* SPDX-License-Identifier: Apache-2.0 */
/* An application that hears itself. Its message was only initialized, as sources for ROS 2 do; ends with 0 when it heard. */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/string.h>
#include <stdbool.h>
#include <string.h>

static bool heard;

static void word_came(const void * message)
{
  const std_msgs__msg__String * word = message;

  heard = strcmp(word->data.data, "hello") == 0;
}

int main(void)
{
  static char hello[] = "hello";
  rcl_allocator_t allocator = rcl_get_default_allocator();
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  std_msgs__msg__String said = {{hello, sizeof(hello) - 1u, sizeof(hello)}};
  std_msgs__msg__String word;

  if (
    !std_msgs__msg__String__init(&word) || rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "parrot", "", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(&publisher, &node, type, "words") != RCL_RET_OK ||
    rclc_subscription_init_default(&subscription, &node, type, "words") != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 1, &allocator) != RCL_RET_OK ||
    rclc_executor_add_subscription(&executor, &subscription, &word, word_came, ON_NEW_DATA) != RCL_RET_OK) {
    return 2;
  }
  for (int i = 0; i < 100 && !heard; ++i) {
    if (rcl_publish(&publisher, &said, NULL) != RCL_RET_OK) {
      return 3;
    }
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
  }
  std_msgs__msg__String__fini(&word);
  return heard ? 0 : 1;
}
