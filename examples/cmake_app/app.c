/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes the speed of two wheels and how often they have turned; the same source for a PC and a microcontroller. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <robot_msgs/msg/wheel_speeds.h>
#include <std_msgs/msg/int32.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t speeds_publisher;
static rcl_publisher_t turns_publisher;
static rcl_timer_t timer;
static rclc_executor_t executor;
static robot_msgs__msg__WheelSpeeds speeds = {.left = 6.25f, .right = 6.5f};
static std_msgs__msg__Int32 turns;

static void publish(rcl_timer_t * due, int64_t last_call_time)
{
  RCLC_UNUSED(due);
  RCLC_UNUSED(last_call_time);
  if (rcl_publish(&speeds_publisher, &speeds, NULL) != RCL_RET_OK) {
    rcl_reset_error(); /* the next one is newer */
  }
  if (rcl_publish(&turns_publisher, &turns, NULL) == RCL_RET_OK) {
    ++turns.data;
  } else {
    rcl_reset_error();
  }
}

static bool start(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "wheels", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_best_effort(
           &speeds_publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(robot_msgs, msg, WheelSpeeds),
           "wheel_speeds") == RCL_RET_OK &&
         rclc_publisher_init_default(
           &turns_publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "turns") ==
           RCL_RET_OK &&
         rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(100), publish, true) == RCL_RET_OK &&
         rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK &&
         rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK;
}

int main(void)
{
  if (!start()) {
    return 1; /* no agent; a board starts again */
  }
  return rclc_executor_spin(&executor) == RCL_RET_OK ? 0 : 1;
}
