/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_publisher.h"

#include "microros/error.h"
#include "microros/rmw_client.h"
#include "microros/rmw_node.h"
#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

static bool publisher_fits(const microros_message_type_t * type, uint8_t flags)
{
  const size_t capacity = xrce_route_capacity((flags & XRCE_QOS_RELIABLE) != 0u);

  if (type->max_encoded_size <= capacity) {
    return true;
  }
  microros_error_set(
    MICROROS_ERROR_STREAM_SMALL, type->dds_type_name, NULL, type->max_encoded_size, (uint32_t)capacity);
  return false;
}

static rmw_publisher_t * publisher_hand_out(xrce_writer_t * writer)
{
  static rmw_publisher_t publishers[MICROROS_PUBLISHERS_MAX]; /* handed out by place */
  rmw_publisher_t * publisher = &publishers[writer->index];

  publisher->implementation_identifier = rmw_implementation_identifier;
  publisher->data = writer;
  publisher->topic_name = writer->topic;
  return publisher;
}

rmw_ret_t rmw_publisher_open(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, const char * topic,
  const rmw_qos_profile_t * qos, rmw_publisher_t ** publisher)
{
  xrce_client_t * client = node->context->impl;
  const microros_message_type_t * type = type_support->data;
  const rmw_name_t name = rmw_name_of_topic(topic, node->name, node->namespace_);
  uint8_t flags;
  uint16_t depth;
  uint16_t index;
  xrce_writer_t * writer;
  xrce_outcome_t outcome;
  const char * refused = rmw_qos_to_xrce(qos, &flags, &depth);

  if (refused != NULL) {
    microros_error_set(MICROROS_ERROR_QOS, topic, refused, 0, 0);
    return RMW_RET_UNSUPPORTED;
  }
  if (!publisher_fits(type, flags)) {
    return RMW_RET_ERROR;
  }
  index = rmw_publisher_take(client, rmw_node_index(node), &name, topic, type);
  if (index == RMW_NO_PLACE) {
    return RMW_RET_ERROR;
  }
  writer = &client->writers[index];
  writer->client = client;
  writer->type = type;
  writer->index = index;
  writer->participant = rmw_node_index(node);
  writer->qos = flags;
  writer->depth = depth;
  xrce_entities_add(client, &writer->state);
  outcome = xrce_entities_await_writer(client, index, client->create_timeout_ms);
  if (outcome != XRCE_DONE) {
    xrce_entities_remove(client, &writer->state);
    return rmw_report_outcome(client, outcome, false, writer->topic);
  }
  *publisher = publisher_hand_out(writer);
  return RMW_RET_OK;
}

void rmw_publisher_close(rmw_publisher_t * publisher)
{
  xrce_writer_t * writer = publisher->data;

  publisher->implementation_identifier = NULL;
  xrce_entities_remove(writer->client, &writer->state);
  (void)xrce_entities_await_writer(writer->client, writer->index, writer->client->close_timeout_ms);
}

bool rmw_publisher_is_open(const rmw_publisher_t * publisher)
{
  const xrce_writer_t * writer;

  if (publisher == NULL || publisher->implementation_identifier != rmw_implementation_identifier) {
    return false;
  }
  writer = publisher->data;
  return writer->state.wanted;
}
