/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/publisher.h"

#include "microros/error.h"

#include <stddef.h>

rcl_ret_t rclc_publisher_init(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name, const rmw_qos_profile_t * qos_profile)
{
  rcl_publisher_options_t options;

  if (publisher == NULL || qos_profile == NULL) {
    microros_error_set(MICROROS_ERROR_ARGUMENT, "publisher or qos_profile", NULL, 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  *publisher = rcl_get_zero_initialized_publisher(); /* as rclc does: the caller's may be uninitialized memory */
  options = rcl_publisher_get_default_options();
  options.qos = *qos_profile;
  return rcl_publisher_init(publisher, node, type_support, topic_name, &options);
}

rcl_ret_t rclc_publisher_init_default(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name)
{
  return rclc_publisher_init(publisher, node, type_support, topic_name, &rmw_qos_profile_default);
}

rcl_ret_t rclc_publisher_init_best_effort(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name)
{
  return rclc_publisher_init(publisher, node, type_support, topic_name, &rmw_qos_profile_sensor_data);
}
