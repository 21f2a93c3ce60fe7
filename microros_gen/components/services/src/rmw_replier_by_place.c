/* SPDX-License-Identifier: Apache-2.0 */
/* Services that a component opens by itself: the plan has their places. */
#include "microros/lock.h"
#include "microros/rmw_node.h"
#include "microros/rmw_replier_places.h"
#include "microros/rmw_service.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

rmw_ret_t rmw_replier_open_by_place(
  const rmw_node_t * node, const rosidl_service_type_support_t * type_support, uint16_t depth, uint16_t * at,
  rmw_service_t ** service)
{
  const microros_service_type_t * type = type_support->data;
  const xrce_service_t opened = {type, type->response};
  xrce_endpoint_t wanted = {
    .client = node->context->impl,
    .type = type->request,
    .depth = depth,
    .participant = rmw_node_index(node),
    .qos = (uint8_t)XRCE_QOS_RELIABLE | (uint8_t)XRCE_QOS_KEEP_LAST};
  rmw_ret_t result;

  microros_lock();
  result = rmw_service_open_by_place(&wanted, &opened, at);
  if (result == RMW_RET_OK) {
    *service = rmw_replier_prepare(&wanted.client->endpoints[wanted.index]);
  }
  microros_unlock();
  return result;
}
