/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes the speeds of two wheels, which follow a target. Waits for the agent. */
#include <Arduino.h>

#include <micro_ros_platformio.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <robot_msgs/msg/wheel_speeds.h>
#include <std_msgs/msg/float32.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rcl_timer_t timer;
static rclc_executor_t executor;
static robot_msgs__msg__WheelSpeeds speeds;
static std_msgs__msg__Float32 target;

static void on_target(const void *)
{
  speeds.left = target.data;
  speeds.right = target.data;
}

static void on_timer(rcl_timer_t *, int64_t)
{
  (void)rcl_publish(&publisher, &speeds, nullptr);
}

static bool create()
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  return rclc_support_init(&support, 0, nullptr, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "wheels", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_default(
           &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(robot_msgs, msg, WheelSpeeds), "wheel_speeds") ==
           RCL_RET_OK &&
         rclc_subscription_init_default(
           &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Float32), "target") ==
           RCL_RET_OK &&
         rclc_timer_init_default(&timer, &support, RCL_MS_TO_NS(100), on_timer) == RCL_RET_OK &&
         rclc_executor_init(&executor, &support.context, 2, &allocator) == RCL_RET_OK &&
         rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK &&
         rclc_executor_add_subscription(&executor, &subscription, &target, on_target, ON_NEW_DATA) ==
           RCL_RET_OK;
}

static void destroy()
{
  (void)rclc_executor_fini(&executor);
  (void)rcl_timer_fini(&timer);
  (void)rcl_subscription_fini(&subscription, &node);
  (void)rcl_publisher_fini(&publisher, &node);
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

void setup()
{
  Serial.begin(115200);
  set_microros_serial_transports(Serial);
}

/* After an outage of the agent, the library creates everything again by itself. */
void loop()
{
  static bool is_ready;

  if (is_ready) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
  } else if (rmw_uros_ping_agent(500, 1) == RMW_RET_OK) {
    is_ready = create();
    if (!is_ready) {
      destroy();
    }
  } else {
    delay(500);
  }
}
