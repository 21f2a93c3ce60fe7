/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by rclc and rcl: opens a client with a QoS. Internal; `client` and `qos` are already checked. */
#ifndef MICROROS_RCL_CLIENT_OPEN_H
#define MICROROS_RCL_CLIENT_OPEN_H

#include "rcl/client.h"

#ifdef __cplusplus
extern "C" {
#endif

rcl_ret_t rcl_client_open(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rmw_qos_profile_t * qos);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLIENT_OPEN_H */
