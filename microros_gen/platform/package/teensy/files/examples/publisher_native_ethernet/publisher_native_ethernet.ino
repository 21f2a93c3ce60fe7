// SPDX-License-Identifier: Apache-2.0
// Publishes a counter over UDP: ros2 topic echo /counter
// For a Teensy 4.1 with the Ethernet kit and the library NativeEthernet of Teensyduino.
#include <NativeEthernet.h>
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

byte mac[] = {0x02, 0x00, 0x00, 0x00, 0x00, 0x01};  // another one for each board
IPAddress board_ip(192, 168, 1, 177);
IPAddress agent_ip(192, 168, 1, 10);

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
  set_microros_native_ethernet_udp_transports(mac, board_ip, agent_ip, 8888);

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
