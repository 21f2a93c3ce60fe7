/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_publisher.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/rmw_node.h"
#include "microros/rmw_publish_parts.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

static uint16_t publisher_place(const xrce_endpoint_t * writer)
{
  return (uint16_t)(MICROROS_NODES_MAX + writer->index);
}

static bool publisher_fits(const xrce_endpoint_t * writer)
{
  const size_t capacity = xrce_route_capacity((writer->qos & XRCE_QOS_RELIABLE) != 0u);
  const uint32_t size = writer->type->max_encoded_size;

  if (size <= capacity) {
    return true;
  }
  microros_error_set(
    microros_error_stream_small, writer->type->dds_type_name, NULL, size, (uint32_t)capacity);
  return false;
}

static rmw_publisher_t * publisher_prepare(xrce_endpoint_t * writer)
{
  static rmw_publisher_t publishers[MICROROS_PUBLISHERS_MAX]; /* indexed by place */
  rmw_publisher_t * publisher = &publishers[writer->index];

  publisher->implementation_identifier = rmw_implementation_identifier;
  publisher->data = writer;
  publisher->topic_name = writer->name;
  return publisher;
}

rmw_ret_t rmw_publisher_open(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, const char * topic,
  const rmw_qos_profile_t * qos, rmw_publisher_t ** publisher)
{
  const rmw_name_t name = rmw_name_of_topic(topic, node->name, node->namespace_);
  xrce_endpoint_t wanted = {
    .client = node->context->impl, .type = type_support->data, .participant = rmw_node_index(node)};
  const char * refused = rmw_qos_to_xrce(qos, &wanted.qos, &wanted.depth);
  rmw_ret_t result = RMW_RET_ERROR;

  if (refused != NULL) {
    microros_error_set(microros_error_qos, topic, refused, 0, 0);
    return RMW_RET_UNSUPPORTED;
  }
  rmw_qos_add_times(qos, &wanted);
  microros_lock();
  if (rmw_publisher_take(&wanted, &name, topic) && publisher_fits(&wanted)) {
    xrce_endpoint_t * writer = &wanted.client->endpoints[wanted.index];

    *writer = wanted;
    xrce_drops_clear(writer->client, writer->index);
    rmw_publish_parts_clear(writer);
    result = rmw_place_open(writer->client, publisher_place(writer), writer->name);
    if (result == RMW_RET_OK) {
      *publisher = publisher_prepare(writer);
    }
  }
  microros_unlock();
  return result;
}

void rmw_publisher_close(rmw_publisher_t * publisher)
{
  const xrce_endpoint_t * writer = publisher->data;

  microros_lock();
  rmw_place_close(writer->client, publisher_place(writer));
  microros_unlock();
}

/* After rcl_shutdown the client has no endpoints. */
bool rmw_publisher_is_open(const rmw_publisher_t * publisher)
{
  const xrce_endpoint_t * writer;

  if (publisher == NULL) {
    return false;
  }
  writer = publisher->data; /* set for every handle in use */
  if (writer->client == NULL) {
    return false;
  }
  return writer->client->states[publisher_place(writer)].wanted;
}
