/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/subscription.h"

#include "microros/error.h"
#include "microros/rcl_subscription_open.h"
#include "microros/rmw_qos.h"

#include <stddef.h>

/* As in rclc, *subscription may be uninitialized memory. */
rcl_ret_t rclc_subscription_init(
  rcl_subscription_t * subscription, rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name, const rmw_qos_profile_t * qos_profile)
{
  if (subscription != NULL) {
    *subscription = rcl_get_zero_initialized_subscription();
  }
  if (qos_profile == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "qos_profile");
  }
  return rcl_subscription_open(subscription, node, type_support, topic_name, qos_profile);
}

rcl_ret_t rclc_subscription_init_default(
  rcl_subscription_t * subscription, rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name)
{
  return rclc_subscription_init(subscription, node, type_support, topic_name, rmw_qos_default());
}

rcl_ret_t rclc_subscription_init_best_effort(
  rcl_subscription_t * subscription, rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name)
{
  return rclc_subscription_init(subscription, node, type_support, topic_name, &rmw_qos_profile_sensor_data);
}
