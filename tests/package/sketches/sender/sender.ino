// SPDX-License-Identifier: Apache-2.0
// Publishes a counter: a sketch for a board with 2 KiB of RAM, with a plan for it.
#include <micro_ros_arduino.h>

#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

rcl_allocator_t allocator;
rclc_support_t support;
rcl_node_t node;
rcl_publisher_t publisher;
std_msgs__msg__Int32 counter;

void setup() {
  set_microros_transports();
  allocator = rcl_get_default_allocator();
  while (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    delay(100);
  }
  rclc_node_init_default(&node, "uno", "", &support);
  rclc_publisher_init_best_effort(&publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
}

void loop() {
  delay(100);
  counter.data++;
  rcl_publish(&publisher, &counter, NULL);
}
