/* SPDX-License-Identifier: Apache-2.0 */
/* Services that a component opens by itself: the plan has their places. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_by_place.h"
#include "microros/rmw_declared.h"
#include "microros/rmw_node.h"
#include "microros/rmw_replier_places.h"
#include "microros/rmw_service_start.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

enum {
  REPLIERS_BEGIN = XRCE_REPLIERS_AT - MICROROS_NODES_MAX,
  REPLIERS_END = XRCE_REQUESTERS_AT - MICROROS_NODES_MAX
};

static rmw_ret_t replier_open_by_place(
  xrce_endpoint_t * wanted, const xrce_service_t * service, uint16_t * at, rmw_service_t ** opened)
{
  rmw_ret_t result;

  if (*at < (uint16_t)REPLIERS_BEGIN) {
    *at = (uint16_t)REPLIERS_BEGIN;
  }
  if (!rmw_declared_take(wanted, at, (uint16_t)REPLIERS_END, service->type->dds_type_name)) {
    microros_error_set(
      wanted->name != NULL ? microros_error_service_open : microros_error_service_undeclared, wanted->name,
      service->type->dds_type_name, 0, 0);
    return RMW_RET_ERROR;
  }
  result = rmw_service_start(wanted, service);
  if (result == RMW_RET_OK) {
    *opened = rmw_replier_prepare(&wanted->client->endpoints[wanted->index]);
  }
  return result;
}

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
  result = replier_open_by_place(&wanted, &opened, at, service);
  microros_unlock();
  return result;
}
