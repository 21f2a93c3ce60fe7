// SPDX-License-Identifier: Apache-2.0
// Answers each number on /to_board with twice its value on /from_board, as Int32 and in a Twist.
#ifdef __has_include
#if __has_include("transport_of_test.h")
#include "transport_of_test.h"
#endif
#endif
#include <micro_ros_arduino.h>

#include <geometry_msgs/msg/twist.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#ifndef BEGIN_TRANSPORT
#define BEGIN_TRANSPORT() set_microros_transports()
#endif

rcl_allocator_t allocator;
rclc_support_t support;
rcl_node_t node;
rcl_publisher_t number_publisher;
rcl_publisher_t twist_publisher;
rcl_subscription_t subscription;
rclc_executor_t executor;
std_msgs__msg__Int32 received;
std_msgs__msg__Int32 number;
geometry_msgs__msg__Twist twist;

void check(rcl_ret_t result) {
  while (result != RCL_RET_OK) {
    delay(1000);
  }
}

void on_number(const void * message) {
  number.data = 2 * ((const std_msgs__msg__Int32 *)message)->data;
  twist.angular.z = -0.5 * number.data;
  rcl_publish(&number_publisher, &number, NULL);
  rcl_publish(&twist_publisher, &twist, NULL);
}

void setup() {
  BEGIN_TRANSPORT();
  allocator = rcl_get_default_allocator();
  while (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    delay(100);
  }
  check(rclc_node_init_default(&node, "echo", "", &support));
  check(rclc_publisher_init_default(
    &number_publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "from_board"));
  check(rclc_publisher_init_default(
    &twist_publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(geometry_msgs, msg, Twist), "twist_from_board"));
  check(rclc_subscription_init_default(
    &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "to_board"));
  check(rclc_executor_init(&executor, &support.context, 1, &allocator));
  check(rclc_executor_add_subscription(&executor, &subscription, &received, on_number, ON_NEW_DATA));
}

void loop() {
  rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
}
