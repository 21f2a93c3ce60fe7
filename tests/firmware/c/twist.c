/* SPDX-License-Identifier: Apache-2.0 */
/* For an Arduino: what arrives on /cmd_vel is published as numbers of /temperature. */
#include <geometry_msgs/msg/twist.h>
#include <rcl/error_handling.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <sensor_msgs/msg/temperature.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rclc_executor_t executor;
static geometry_msgs__msg__Twist received;
static sensor_msgs__msg__Temperature sent;
static sensor_msgs__msg__Temperature__Storage storage;

static void on_velocity(const void * untyped)
{
  const geometry_msgs__msg__Twist * message = untyped;

  sent.temperature = message->linear.x;
  sent.variance = message->angular.z;
  if (rcl_publish(&publisher, &sent, NULL) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

static rcl_ret_t start(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  result = result == RCL_RET_OK ? rclc_node_init_default(&node, "uno", "", &support) : result;
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_best_effort(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, Temperature), "temperature");
  }
  if (result == RCL_RET_OK) {
    result = rclc_subscription_init_best_effort(
      &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(geometry_msgs, msg, Twist), "cmd_vel");
  }
  result = result == RCL_RET_OK ? rclc_executor_init(&executor, &support.context, 1, &allocator) : result;
  return result == RCL_RET_OK
           ? rclc_executor_add_subscription(&executor, &subscription, &received, on_velocity, ON_NEW_DATA)
           : result;
}

int main(void)
{
  sensor_msgs__msg__Temperature__bind(&sent, &storage);
  if (start() != RCL_RET_OK) {
    return 1; /* the board restarts after a second */
  }
  return rclc_executor_spin(&executor) == RCL_RET_OK ? 0 : 1;
}
