/* SPDX-License-Identifier: Apache-2.0 */
/* The application file declares no service: none can be opened. */
#include "microros/rmw_service.h"

#include <stddef.h>

rmw_ret_t rmw_replier_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_service_t ** service)
{
  const microros_service_type_t * type = type_support->data;

  (void)node;
  (void)qos;
  (void)service;
  microros_error_set(microros_error_service_undeclared, name, type->dds_type_name, 0, 0);
  return RMW_RET_ERROR;
}

void rmw_replier_close(rmw_service_t * service)
{
  (void)service;
}

bool rmw_replier_is_open(const rmw_service_t * service)
{
  (void)service;
  return false;
}

bool rmw_replier_is_ready(const rmw_service_t * service)
{
  (void)service;
  return false;
}

void rmw_replier_pump(const rmw_service_t * service)
{
  (void)service;
}

rmw_ret_t rmw_replier_take(
  const rmw_service_t * service, rmw_service_info_t * info, void * ros_request, bool * taken)
{
  (void)service;
  (void)info;
  (void)ros_request;
  *taken = false;
  return RMW_RET_ERROR;
}

rmw_ret_t rmw_replier_respond(
  const rmw_service_t * service, const rmw_request_id_t * request, const void * ros_response)
{
  (void)service;
  (void)request;
  (void)ros_response;
  return RMW_RET_ERROR;
}
