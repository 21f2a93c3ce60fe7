/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_clock_source.h"

#include "microros/lock.h"
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
static bool source_is_followed; /* a task sets the clocks: another one neither sets them nor changes source_time */

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

/* Returns whether a sample was taken. */
static bool source_take(void)
{
  rosgraph_msgs__msg__Clock message;
  bool taken = false;

  if (source_is_followed || microros_lock_is_silent() || !source_is_open()) {
    return false;
  }
  /* A refused sample is counted for the subscription; the next sample carries the time again. */
  if (rmw_subscription_take(source_subscription, &message, &taken) != RMW_RET_OK || !taken) {
    return false;
  }
  source_time = message.clock.sec * source_ns_per_s + (int64_t)message.clock.nanosec;
  source_is_followed = true;
  return true;
}

void rcl_clock_source_follow(void)
{
  bool is_taken;

  microros_lock();
  is_taken = source_take();
  microros_unlock();
  if (is_taken) {
    rcl_ros_clocks_set(source_time); /* without the lock: it calls the jump callbacks */
    microros_lock();
    source_is_followed = false;
    microros_unlock();
  }
}

rcl_time_point_value_t rcl_clock_source_time(void)
{
  return source_time;
}
