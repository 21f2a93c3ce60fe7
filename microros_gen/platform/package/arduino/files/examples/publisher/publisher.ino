// SPDX-License-Identifier: Apache-2.0
// Publishes a counter every second: ros2 topic echo /counter
#include <micro_ros_arduino.h>

#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

rcl_allocator_t allocator;
rclc_support_t support;
rcl_node_t node;
rcl_publisher_t publisher;
rcl_timer_t timer;
rclc_executor_t executor;
std_msgs__msg__Int32 counter;

// Stops and blinks if a call fails.
void check(rcl_ret_t result) {
  while (result != RCL_RET_OK) {
    digitalWrite(LED_BUILTIN, !digitalRead(LED_BUILTIN));
    delay(100);
  }
}

void on_timer(rcl_timer_t *, int64_t) {
  rcl_publish(&publisher, &counter, NULL);  // a sample may be lost: the next one follows
  counter.data++;
}

void setup() {
  pinMode(LED_BUILTIN, OUTPUT);
  set_microros_transports();  // Serial, 115200 baud

  allocator = rcl_get_default_allocator();
  while (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    delay(100);  // until the agent is there
  }
  check(rclc_node_init_default(&node, "arduino", "", &support));
  check(rclc_publisher_init_default(
    &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "counter"));
  check(rclc_timer_init_default(&timer, &support, RCL_MS_TO_NS(1000), on_timer));
  check(rclc_executor_init(&executor, &support.context, 1, &allocator));
  check(rclc_executor_add_timer(&executor, &timer));
}

void loop() {
  rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
}
