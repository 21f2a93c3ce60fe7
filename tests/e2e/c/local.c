/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node that hears itself: /said goes to ROS, too, /told comes from ROS, too, /inside stays here. Ends with 0 when the last
 * message of ROS was received, and each local message once, in order. */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>
#include <stdio.h>

/* The test ends a program that does not end; a round takes 10 ms, on a busy machine more. */
enum { TOPICS = 3, FROM_ROS = 100000, LAST = FROM_ROS + 4, TURNS = 20000 };

static int32_t next_own[TOPICS];
static int32_t next_ros = FROM_ROS;
static bool wrong;

static void hear(const void * message, void * context)
{
  const std_msgs__msg__Int32 * number = message;
  const size_t topic = (size_t)((int32_t *)context - next_own);
  int32_t * next = number->data >= FROM_ROS && topic == 1u ? &next_ros : &next_own[topic];

  if (number->data != *next) {
    (void)fprintf(stderr, "topic %d: %d instead of %d\n", (int)topic, (int)number->data, (int)*next);
    wrong = true;
  }
  ++*next;
}

int main(void)
{
  static const char * const names[TOPICS] = {"said", "told", "inside"};
  rcl_allocator_t allocator = rcl_get_default_allocator();
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_publisher_t publishers[TOPICS];
  rcl_subscription_t subscriptions[TOPICS];
  std_msgs__msg__Int32 heard[TOPICS];
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  int32_t value = 0;

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "local", &support) != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, TOPICS, &allocator) != RCL_RET_OK) {
    return 2;
  }
  for (size_t i = 0; i < (size_t)TOPICS; ++i) {
    if (
      rclc_publisher_init_default(&publishers[i], &node, type, names[i]) != RCL_RET_OK ||
      rclc_subscription_init_default(&subscriptions[i], &node, type, names[i]) != RCL_RET_OK ||
      rclc_executor_add_subscription_with_context(
        &executor, &subscriptions[i], &heard[i], hear, &next_own[i], ON_NEW_DATA) != RCL_RET_OK) {
      return 3;
    }
  }
  for (; next_ros <= LAST && value < TURNS && !wrong; ++value) {
    const std_msgs__msg__Int32 message = {.data = value};

    /* A publish call that finds no room for the agent delivers here all the same: it cannot be repeated. */
    if (rcl_publisher_wait_for_all_acked(&publishers[0], RCL_S_TO_NS(60)) != RCL_RET_OK) {
      return 6;
    }
    for (size_t i = 0; i < (size_t)TOPICS; ++i) {
      if (rcl_publish(&publishers[i], &message, NULL) != RCL_RET_OK) {
        return 4;
      }
    }
    while (next_own[0] <= value || next_own[1] <= value || next_own[2] <= value) {
      if (rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)) != RCL_RET_OK) {
        return 5;
      }
    }
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
  }
  return wrong || next_ros <= LAST;
}
