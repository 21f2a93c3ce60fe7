// SPDX-License-Identifier: Apache-2.0
// Switches the LED: ros2 topic pub --once /led std_msgs/msg/Bool "{data: true}"
#include <micro_ros_arduino.h>

#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/bool.h>

rcl_allocator_t allocator;
rclc_support_t support;
rcl_node_t node;
rcl_subscription_t subscription;
rclc_executor_t executor;
std_msgs__msg__Bool received;

// Stops and blinks if a call fails.
void check(rcl_ret_t result) {
  while (result != RCL_RET_OK) {
    digitalWrite(LED_BUILTIN, !digitalRead(LED_BUILTIN));
    delay(100);
  }
}

void on_led(const void * message) {
  const std_msgs__msg__Bool * led = (const std_msgs__msg__Bool *)message;
  digitalWrite(LED_BUILTIN, led->data ? HIGH : LOW);
}

void setup() {
  pinMode(LED_BUILTIN, OUTPUT);
  set_microros_transports();  // Serial, 115200 baud

  allocator = rcl_get_default_allocator();
  while (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    delay(100);  // until the agent is there
  }
  check(rclc_node_init_default(&node, "arduino", "", &support));
  check(rclc_subscription_init_default(
    &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Bool), "led"));
  check(rclc_executor_init(&executor, &support.context, 1, &allocator));
  check(rclc_executor_add_subscription(&executor, &subscription, &received, on_led, ON_NEW_DATA));
}

void loop() {
  rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
}
