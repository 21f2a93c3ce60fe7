/* SPDX-License-Identifier: Apache-2.0 */
/* The application file declares no client: none can be opened. */
#include "microros/rmw_service.h"

#include <stddef.h>

rmw_ret_t rmw_requester_open(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, const char * name,
  const rmw_qos_profile_t * qos, rmw_client_t ** client)
{
  const microros_service_type_t * type = type_support->data;

  (void)node;
  (void)qos;
  (void)client;
  microros_error_set(microros_error_client_undeclared, name, type->dds_type_name, 0, 0);
  return RMW_RET_ERROR;
}

void rmw_requester_close(rmw_client_t * client)
{
  (void)client;
}

bool rmw_requester_is_open(const rmw_client_t * client)
{
  (void)client;
  return false;
}

bool rmw_requester_is_ready(const rmw_client_t * client)
{
  (void)client;
  return false;
}

void rmw_requester_pump(const rmw_client_t * client)
{
  (void)client;
}

rmw_ret_t rmw_requester_take(
  const rmw_client_t * client, rmw_service_info_t * info, void * ros_response, bool * taken)
{
  (void)client;
  (void)info;
  (void)ros_response;
  *taken = false;
  return RMW_RET_ERROR;
}

rmw_ret_t rmw_requester_send(const rmw_client_t * client, const void * ros_request, int64_t * sequence_number)
{
  (void)client;
  (void)ros_request;
  (void)sequence_number;
  return RMW_RET_ERROR;
}
