/* SPDX-License-Identifier: Apache-2.0 */
/* Service clients with common QoS. */
#ifndef MICROROS_RCLC_CLIENT_H
#define MICROROS_RCLC_CLIENT_H

#include "rcl/client.h"
#include "rclc/types.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* rcl_client_init with rmw_qos_profile_services_default; *client may be uninitialized. */
rcl_ret_t rclc_client_init_default(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name);

/*
 * Same with best effort, which XRCE does not carry for services: they are reliable between client and
 * agent. */
rcl_ret_t rclc_client_init_best_effort(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name);

/* Same with the caller's QoS. */
rcl_ret_t rclc_client_init(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rmw_qos_profile_t * qos_profile);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_CLIENT_H */
