/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes one message of the workspace. */
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <robot_interfaces/msg/robot.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static robot_interfaces__msg__Robot robot;

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "robot", "", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(robot_interfaces, msg, Robot), "robot") != RCL_RET_OK) {
    return 1;
  }
  robot.wheels[0].speed = 6.25f;
  return rcl_publish(&publisher, &robot, NULL) == RCL_RET_OK ? 0 : 1;
}
