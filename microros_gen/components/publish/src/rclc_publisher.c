/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/publisher.h"

#include "microros/error.h"
#include "microros/rcl_publisher_open.h"
#include "microros/rmw_qos.h"

#include <stddef.h>

/* As in rclc, *publisher may be uninitialized memory. */
rcl_ret_t rclc_publisher_init(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name, const rmw_qos_profile_t * qos_profile)
{
  if (publisher != NULL) {
    *publisher = rcl_get_zero_initialized_publisher();
  }
  if (qos_profile == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "qos_profile");
  }
  return rcl_publisher_open(publisher, node, type_support, topic_name, qos_profile);
}

rcl_ret_t rclc_publisher_init_default(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name)
{
  return rclc_publisher_init(publisher, node, type_support, topic_name, rmw_qos_default());
}

rcl_ret_t rclc_publisher_init_best_effort(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name)
{
  return rclc_publisher_init(publisher, node, type_support, topic_name, &rmw_qos_profile_sensor_data);
}
