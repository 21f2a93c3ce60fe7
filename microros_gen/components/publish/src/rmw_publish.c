/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local_publish.h"
#include "microros/rmw_peer_publish.h"
#include "microros/rmw_publish_parts.h"
#include "microros/rmw_publisher.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"
#include "rmw/rmw.h"

#include <stddef.h>

/* Bytes 00 01 00 00: XCDR1, little endian, no options (OMG DDS-XTypes 1.3, 7.6.3.1.2). */
enum { PUBLISH_ENCAPSULATION_SIZE = 4, PUBLISH_LITTLE_ENDIAN = 1 };

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
