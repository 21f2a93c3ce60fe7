/* SPDX-License-Identifier: Apache-2.0 */
/* Publishers that a component opens by itself: the plan has their places. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_by_place.h"
#include "microros/rmw_declared.h"
#include "microros/rmw_node.h"
#include "microros/rmw_publish_parts.h"
#include "microros/rmw_publisher_places.h"
#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

static rmw_ret_t publisher_open_by_place(xrce_endpoint_t * wanted)
{
  xrce_endpoint_t * writer;
  uint16_t at = 0;

  if (!rmw_declared_take(wanted, &at, MICROROS_PUBLISHERS_MAX, wanted->type->dds_type_name)) {
    microros_error_set(
      wanted->name != NULL ? microros_error_publisher_open : microros_error_publisher_undeclared,
      wanted->name, wanted->type->dds_type_name, 0, 0);
    return RMW_RET_ERROR;
  }
  writer = &wanted->client->endpoints[wanted->index];
  *writer = *wanted;
  xrce_drops_clear(writer->client, writer->index);
  rmw_publish_parts_clear(writer);
  return rmw_place_open(writer->client, (uint16_t)(MICROROS_NODES_MAX + writer->index), writer->name);
}

rmw_ret_t rmw_publisher_open_by_place(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, uint16_t depth,
  rmw_publisher_t ** publisher)
{
  xrce_endpoint_t wanted = {
    .client = node->context->impl,
    .type = type_support->data,
    .depth = depth,
    .participant = rmw_node_index(node),
    .qos = (uint8_t)XRCE_QOS_RELIABLE | (uint8_t)XRCE_QOS_KEEP_LAST};
  rmw_ret_t result;

  microros_lock();
  result = publisher_open_by_place(&wanted);
  if (result == RMW_RET_OK) {
    *publisher = rmw_publisher_prepare(&wanted.client->endpoints[wanted.index]);
  }
  microros_unlock();
  return result;
}
