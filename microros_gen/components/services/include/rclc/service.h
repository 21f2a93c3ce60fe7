/* SPDX-License-Identifier: Apache-2.0 */
/* Service servers with common QoS. */
#ifndef MICROROS_RCLC_SERVICE_H
#define MICROROS_RCLC_SERVICE_H

#include "rcl/service.h"
#include "rclc/types.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* rcl_service_init with rmw_qos_profile_services_default; *service may be uninitialized. */
rcl_ret_t rclc_service_init_default(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name);

/*
 * Same with best effort, which XRCE does not carry for services: they are reliable between client and
 * agent. */
rcl_ret_t rclc_service_init_best_effort(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name);

/* Same with the caller's QoS. */
rcl_ret_t rclc_service_init(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rmw_qos_profile_t * qos_profile);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_SERVICE_H */
