/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_publisher.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local_publish.h"
#include "microros/rmw_node.h"
#include "microros/rmw_peer_publish.h"
#include "microros/rmw_publish_parts.h"
#include "microros/rmw_publisher_places.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"
#include "rmw/rmw.h"

#include <stddef.h>

/* Bytes 00 01 00 00: XCDR1, little endian, no options (OMG DDS-XTypes 1.3, 7.6.3.1.2). */
enum { PUBLISH_ENCAPSULATION_SIZE = 4, PUBLISH_LITTLE_ENDIAN = 1 };

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

rmw_publisher_t rmw_publishers[MICROROS_PUBLISHERS_MAX]; /* indexed by place */

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
      *publisher = rmw_publisher_prepare(writer);
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

/* `fault` is only set for a refused message, not for one that was already encoded. */
static rmw_ret_t publish_report(
  const xrce_endpoint_t * writer, xrce_write_t outcome, const cdr_fault_t * fault)
{
  switch (outcome) {
    case XRCE_WRITTEN:
    case XRCE_WRITE_DROPPED:
      return RMW_RET_OK;
    case XRCE_WRITE_REFUSED:
      return rmw_encode_refuse(writer->type, fault);
    case XRCE_WRITE_FULL:
      microros_error_set(
        microros_error_stream_full, writer->name, NULL, xrce_route_unacknowledged(writer->client), 0);
      break;
    case XRCE_WRITE_NO_SESSION:
      microros_error_set(microros_error_no_session, writer->name, NULL, 0, 0);
      break;
    case XRCE_WRITE_NOT_SENT:
    default:
      microros_error_set(microros_error_not_sent, writer->name, NULL, 0, 0);
      break;
  }
  return RMW_RET_ERROR;
}

rmw_ret_t rmw_publisher_write(const rmw_publisher_t * publisher, const void * ros_message)
{
  cdr_fault_t fault; /* set if the message is refused */
  xrce_endpoint_t * writer = publisher->data;
  rmw_ret_t result = RMW_RET_OK;
  rmw_ret_t of_peers = RMW_RET_OK;
  bool apart;

  if (rmw_publish_parts(writer, ros_message, &result)) {
    return result;
  }
  microros_lock();
  apart = rmw_peer_publish(writer, ros_message, &of_peers);
  if (!rmw_local_publish(writer, ros_message, &result) && !apart) {
    const xrce_write_t outcome = xrce_write_message(writer, ros_message, &fault);

    if (outcome != XRCE_WRITTEN) {
      result = publish_report(writer, outcome, &fault);
    }
  }
  microros_unlock();
  return result != RMW_RET_OK ? result : of_peers;
}

rmw_ret_t rmw_publish(
  const rmw_publisher_t * publisher, const void * ros_message, rmw_publisher_allocation_t * allocation)
{
  (void)allocation;
  if (ros_message == NULL || !rmw_publisher_is_open(publisher)) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "publisher or message");
  }
  return rmw_publisher_write(publisher, ros_message);
}

rmw_ret_t rmw_publish_serialized_message(
  const rmw_publisher_t * publisher, const rmw_serialized_message_t * serialized_message,
  rmw_publisher_allocation_t * allocation)
{
  static const cdr_fault_t none = {.field = ""}; /* contents of encoded messages are not checked */
  const uint8_t * bytes;
  xrce_endpoint_t * writer;
  size_t capacity;
  size_t size;
  rmw_ret_t result = RMW_RET_OK;
  rmw_ret_t of_peers = RMW_RET_OK;
  bool apart;

  (void)allocation;
  if (serialized_message == NULL || serialized_message->buffer == NULL || !rmw_publisher_is_open(publisher)) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "publisher or serialized_message");
  }
  writer = publisher->data;
  bytes = serialized_message->buffer;
  size = serialized_message->buffer_length;
  capacity = PUBLISH_ENCAPSULATION_SIZE + xrce_route_capacity((writer->qos & XRCE_QOS_RELIABLE) != 0u);
  if (
    size <= PUBLISH_ENCAPSULATION_SIZE || size > capacity || bytes[0] != 0u ||
    bytes[1] != PUBLISH_LITTLE_ENDIAN) {
    microros_error_set(microros_error_serialized, NULL, NULL, (uint32_t)size, (uint32_t)capacity);
    return RMW_RET_ERROR;
  }
  bytes = &bytes[PUBLISH_ENCAPSULATION_SIZE];
  size -= PUBLISH_ENCAPSULATION_SIZE;
  microros_lock();
  apart = rmw_peer_publish_body(writer, bytes, size, &of_peers);
  if (!rmw_local_publish_body(writer, bytes, size, &result) && !apart) {
    result = publish_report(writer, xrce_write_body(writer, bytes, size), &none);
  }
  microros_unlock();
  return result != RMW_RET_OK ? result : of_peers;
}
