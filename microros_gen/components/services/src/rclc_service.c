/* SPDX-License-Identifier: Apache-2.0 */
/* Services and clients. */
#include "rclc/service.h"

#include "microros/error.h"
#include "microros/rcl_client_open.h"
#include "microros/rcl_service_open.h"
#include "rclc/client.h"

#include <stddef.h>

/* As in rclc, *service may be uninitialized memory. */
rcl_ret_t rclc_service_init(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rmw_qos_profile_t * qos_profile)
{
  if (service == NULL || node == NULL || qos_profile == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "service, node or qos_profile");
  }
  *service = rcl_get_zero_initialized_service();
  return rcl_service_open(service, node, type_support, service_name, qos_profile);
}

rcl_ret_t rclc_service_init_default(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name)
{
  return rclc_service_init(service, node, type_support, service_name, &rmw_qos_profile_services_default);
}

rcl_ret_t rclc_service_init_best_effort(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name)
{
  rmw_qos_profile_t qos = rmw_qos_profile_services_default;

  qos.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  return rclc_service_init(service, node, type_support, service_name, &qos);
}

/* As in rclc, *client may be uninitialized memory. */
rcl_ret_t rclc_client_init(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rmw_qos_profile_t * qos_profile)
{
  if (client == NULL || node == NULL || qos_profile == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client, node or qos_profile");
  }
  *client = rcl_get_zero_initialized_client();
  return rcl_client_open(client, node, type_support, service_name, qos_profile);
}

rcl_ret_t rclc_client_init_default(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name)
{
  return rclc_client_init(client, node, type_support, service_name, &rmw_qos_profile_services_default);
}

rcl_ret_t rclc_client_init_best_effort(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name)
{
  rmw_qos_profile_t qos = rmw_qos_profile_services_default;

  qos.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  return rclc_client_init(client, node, type_support, service_name, &qos);
}
