// SPDX-License-Identifier: Apache-2.0
// Adds: ros2 service call /add_two_ints example_interfaces/srv/AddTwoInts "{a: 1, b: 2}"
#include <micro_ros_arduino.h>

#include <example_interfaces/srv/add_two_ints.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

rcl_allocator_t allocator;
rclc_support_t support;
rcl_node_t node;
rcl_service_t service;
rclc_executor_t executor;
example_interfaces__srv__AddTwoInts_Request request;
example_interfaces__srv__AddTwoInts_Response response;

// Stops and blinks if a call fails.
void check(rcl_ret_t result) {
  while (result != RCL_RET_OK) {
    digitalWrite(LED_BUILTIN, !digitalRead(LED_BUILTIN));
    delay(100);
  }
}

void on_request(const void * request_message, void * response_message) {
  const example_interfaces__srv__AddTwoInts_Request * asked =
    (const example_interfaces__srv__AddTwoInts_Request *)request_message;
  example_interfaces__srv__AddTwoInts_Response * answer =
    (example_interfaces__srv__AddTwoInts_Response *)response_message;
  answer->sum = asked->a + asked->b;
}

void setup() {
  pinMode(LED_BUILTIN, OUTPUT);
  set_microros_transports();  // Serial, 115200 baud

  allocator = rcl_get_default_allocator();
  while (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    delay(100);  // until the agent is there
  }
  check(rclc_node_init_default(&node, "arduino", "", &support));
  check(rclc_service_init_default(
    &service, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts), "add_two_ints"));
  check(rclc_executor_init(&executor, &support.context, 1, &allocator));
  check(rclc_executor_add_service(&executor, &service, &request, &response, on_request));
}

void loop() {
  rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
}
