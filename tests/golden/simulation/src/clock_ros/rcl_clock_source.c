/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_clock_source.h"

#include "microros/rcl_clock.h"
#include "microros/rmw_node.h"
#include "microros/rmw_subscription.h"
#include "rmw/qos_profiles.h"
#include "rosgraph_msgs/msg/clock.h"

#include <stddef.h>

static const int64_t source_ns_per_s = 1000000000;

static rmw_subscription_t * source_subscription;
static const rmw_node_t * source_node; /* the owner */
static rcl_time_point_value_t source_time;

static bool source_is_open(void)
{
  return rmw_subscription_is_open(source_subscription);
}

rcl_ret_t rcl_clock_source_open(const rcl_node_t * node)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(rosgraph_msgs, msg, Clock);
  rmw_qos_profile_t qos = rmw_qos_profile_sensor_data; /* best effort, like rclcpp::ClockQoS */

  if (rmw_node_index(node->impl) != 0u || source_is_open()) { /* declared with the first node */
    return RCL_RET_OK;
  }
  qos.depth = 1;
  source_node = node->impl;
  return rmw_subscription_open_clock(node->impl, type, "/clock", &qos, &source_subscription);
}

void rcl_clock_source_close(const rcl_node_t * node)
{
  if (source_is_open() && source_node == node->impl) {
    rmw_subscription_close(source_subscription);
  }
}

void rcl_clock_source_follow(void)
{
  static bool following;
  rosgraph_msgs__msg__Clock message;
  bool taken = false;

  if (following || !source_is_open()) {
    return;
  }
  /* A refused sample is counted for the subscription; the next sample carries the time again. */
  if (rmw_subscription_take(source_subscription, &message, &taken) == RMW_RET_OK && taken) {
    source_time = message.clock.sec * source_ns_per_s + (int64_t)message.clock.nanosec;
    following = true;
    rcl_ros_clocks_set(source_time);
    following = false;
  }
}

rcl_time_point_value_t rcl_clock_source_time(void)
{
  return source_time;
}
