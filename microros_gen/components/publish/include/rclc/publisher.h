/* SPDX-License-Identifier: Apache-2.0 */
/* Publishers with common QoS; codes and waiting as for rcl_publisher_init. */
#ifndef MICROROS_RCLC_PUBLISHER_H
#define MICROROS_RCLC_PUBLISHER_H

#include "rcl/publisher.h"
#include "rclc/types.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* QoS: reliable, volatile, depth 10. */
rcl_ret_t rclc_publisher_init_default(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name);

/* QoS: best effort, volatile, depth 5. */
rcl_ret_t rclc_publisher_init_best_effort(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name);

rcl_ret_t rclc_publisher_init(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name, const rmw_qos_profile_t * qos_profile);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PUBLISHER_H */
