/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shared by rclc and rcl: opens a publisher with a QoS. Internal; pointers except `qos` are already
 * checked. */
#ifndef MICROROS_RCL_PUBLISHER_OPEN_H
#define MICROROS_RCL_PUBLISHER_OPEN_H

#include "rcl/publisher.h"

#ifdef __cplusplus
extern "C" {
#endif

rcl_ret_t rcl_publisher_open(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name, const rmw_qos_profile_t * qos);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_PUBLISHER_OPEN_H */
