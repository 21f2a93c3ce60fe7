/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_local.h"

#include "microros/epoch.h"
#include "microros/error.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_decode.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local_deliver.h"
#include "microros/rmw_local_publish.h"
#include "microros/rmw_local_shared.h"
#include "microros/rmw_local_take.h"
#include "microros/rmw_local_wake.h"
#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_gate.h"
#include "microros/xrce_local_fresh.h"
#include "microros/xrce_read.h"
#include "microros/xrce_wire.h"
#include "rmw/rmw.h"

#include <stddef.h>
#include <string.h>

rmw_local_state_t rmw_local_states[MICROROS_LOCAL_QUEUES];
bool xrce_local_fresh;

void rmw_local_open(const xrce_endpoint_t * reader)
{
  const uint8_t queue = rmw_local_queue_of[reader->index - MICROROS_PUBLISHERS_MAX];

  if (queue != (uint8_t)RMW_LOCAL_NONE) {
    rmw_local_states[queue].head = 0;
    rmw_local_states[queue].count = 0;
    if (rmw_local_queues[queue].bind != NULL) {
      rmw_local_queues[queue].bind();
    }
    rmw_shared_opened(reader);
  }
}

/* Returns whether a publisher may deliver now; what it may not is dropped like what goes to the agent. */
static bool local_may(const xrce_endpoint_t * writer, const rmw_local_route_t * route)
{
  if (route->deliver == NULL) {
    return false;
  }
  if (xrce_gate_is_open(writer)) {
    return true;
  }
  if (route->only) {
    xrce_drops_add(writer->client, writer->index); /* of others those who send count it */
  }
  return false;
}

bool rmw_local_has_route(const xrce_endpoint_t * writer)
{
  return rmw_local_routes[writer->index].deliver != NULL || rmw_shared_has_ring(writer);
}

bool rmw_local_publish(const xrce_endpoint_t * writer, const void * message, rmw_ret_t * result)
{
  const rmw_local_route_t * route = &rmw_local_routes[writer->index];
  bool only;
  cdr_fault_t fault; /* set if the message is refused */

  if (rmw_shared_has_ring(writer)) {
    *result = rmw_shared_publish(writer, message);
    return true;
  }
  *result = RMW_RET_OK;
  only = route->only;
  if (!local_may(writer, route)) {
    return only;
  }
  if (route->checks && writer->type->encoded_size(message, &fault) == 0u) {
    *result = rmw_encode_refuse(writer->type, &fault);
    return true;
  }
  route->deliver(writer->client, message);
  xrce_local_fresh = true;
  rmw_local_wake();
  return only;
}

bool rmw_local_publish_body(
  const xrce_endpoint_t * writer, const uint8_t * body, size_t size, rmw_ret_t * result)
{
  const rmw_local_route_t * route = &rmw_local_routes[writer->index];
  xrce_client_t * client = writer->client;

  if (rmw_shared_has_ring(writer)) {
    *result = rmw_shared_publish_body(writer, body, size);
    return true;
  }
  *result = RMW_RET_OK;
  if (!local_may(writer, route)) {
    return route->only;
  }
  if (size > writer->type->max_encoded_size) {
    *result = microros_error_named(RMW_RET_ERROR, microros_error_local_capacity, writer->name);
    return true;
  }
  for (const uint8_t * at = route->queues; at != &route->queues[route->count]; ++at) {
    const rmw_local_queue_t * queue = &rmw_local_queues[*at];
    rmw_local_state_t * state = &rmw_local_states[*at];

    if (rmw_local_is_open(client, queue)) {
      const microros_message_type_t * type =
        client->endpoints[MICROROS_PUBLISHERS_MAX + queue->receiver].type;
      const uint8_t slot = rmw_local_begin(client, queue, state);

      *result = rmw_decode(type, body, (uint32_t)size, false, queue->slot(slot));
      if (*result != RMW_RET_OK) {
        return true;
      }
      queue->published_ms[slot] = port_time_ms();
      ++state->count;
    }
  }
  xrce_local_fresh = true;
  rmw_local_wake();
  return route->only;
}

/* Bytes 00 01 00 00: XCDR1, little endian, no options (OMG DDS-XTypes 1.3, 7.6.3.1.2). */
enum { LOCAL_ENCAPSULATION_SIZE = 4, LOCAL_LITTLE_ENDIAN = 1 };

enum { LOCAL_NS_PER_MS = 1000000 };

bool rmw_local_is_ready(const xrce_endpoint_t * reader)
{
  const uint8_t index = rmw_local_queue_of[reader->index - MICROROS_PUBLISHERS_MAX];

  return (index != (uint8_t)RMW_LOCAL_NONE && rmw_local_states[index].count != 0u) ||
         rmw_shared_is_wrong(reader);
}

bool rmw_local_may_wait(const xrce_endpoint_t * reader)
{
  return rmw_local_is_ready(reader) && reader->client->session.now_ms == port_time_ms();
}

/* Returns whether a sample of the agent is older than the oldest message of a queue. */
static bool local_agent_first(
  const xrce_endpoint_t * reader, const rmw_local_queue_t * queue, const rmw_local_state_t * state)
{
  xrce_sample_t sample;

  return xrce_read_peek(reader, &sample) && !xrce_is_due(sample.arrived_ms, queue->published_ms[state->head]);
}

/* Returns the index of the queue whose oldest message is the reader's oldest; RMW_LOCAL_NONE: nothing waits there, or one
 * of the agent is older. */
static uint8_t local_oldest(const xrce_endpoint_t * reader)
{
  const uint8_t index = rmw_local_queue_of[reader->index - MICROROS_PUBLISHERS_MAX];

  if (index == (uint8_t)RMW_LOCAL_NONE || rmw_local_states[index].count == 0u) {
    return RMW_LOCAL_NONE;
  }
  if (
    !rmw_local_queues[index].only &&
    local_agent_first(reader, &rmw_local_queues[index], &rmw_local_states[index])) {
    return RMW_LOCAL_NONE;
  }
  return index;
}

bool rmw_local_describe(const xrce_endpoint_t * reader, rmw_message_info_t * info)
{
  const uint8_t index = local_oldest(reader);
  int64_t epoch_ns;

  if (index == (uint8_t)RMW_LOCAL_NONE) {
    return false;
  }
  epoch_ns = microros_epoch_known_ns();
  if (epoch_ns != 0) { /* otherwise the time of day has not been set yet */
    const uint32_t age_ms =
      port_time_ms() - rmw_local_queues[index].published_ms[rmw_local_states[index].head];

    epoch_ns -= (int64_t)age_ms * LOCAL_NS_PER_MS;
  }
  info->source_timestamp = epoch_ns;
  info->received_timestamp = epoch_ns;
  info->publication_sequence_number = RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED;
  info->reception_sequence_number = RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED;
  info->publisher_gid.implementation_identifier = rmw_implementation_identifier;
  info->from_intra_process = true;
  return true;
}

bool rmw_local_take(const xrce_endpoint_t * reader, void * message, rmw_ret_t * result)
{
  const uint8_t index = local_oldest(reader);

  if (rmw_shared_is_wrong(reader)) {
    *result = rmw_shared_report(reader);
    return true;
  }
  if (index == (uint8_t)RMW_LOCAL_NONE) {
    return false;
  }
  *result = RMW_RET_OK;
  if (!rmw_local_queues[index].remove(message)) {
    *result = microros_error_named(RMW_RET_ERROR, microros_error_local_capacity, reader->name);
  }
  return true;
}

static rmw_ret_t local_serialize(
  const xrce_endpoint_t * reader, const void * message, rmw_serialized_message_t * serialized_message)
{
  cdr_fault_t fault; /* set if the message is refused: the limits of the reader are those of its publishers */
  const size_t size = LOCAL_ENCAPSULATION_SIZE + (size_t)reader->type->encoded_size(message, &fault);

  if (
    serialized_message->buffer_capacity < size &&
    rmw_serialized_message_resize(serialized_message, size) != RCUTILS_RET_OK) {
    return RMW_RET_BAD_ALLOC;
  }
  if (reader->type->encode(message, &serialized_message->buffer[LOCAL_ENCAPSULATION_SIZE], &fault) == 0u) {
    return rmw_encode_refuse(reader->type, &fault);
  }
  (void)memset(serialized_message->buffer, 0, LOCAL_ENCAPSULATION_SIZE);
  serialized_message->buffer[1] = LOCAL_LITTLE_ENDIAN;
  serialized_message->buffer_length = size;
  return RMW_RET_OK;
}

bool rmw_local_take_serialized(
  const xrce_endpoint_t * reader, rmw_serialized_message_t * serialized_message, rmw_ret_t * result)
{
  const uint8_t index = local_oldest(reader);
  const rmw_local_queue_t * queue;
  rmw_local_state_t * state;

  if (rmw_shared_is_wrong(reader)) {
    *result = rmw_shared_report(reader);
    return true;
  }
  if (index == (uint8_t)RMW_LOCAL_NONE) {
    return false;
  }
  queue = &rmw_local_queues[index];
  state = &rmw_local_states[index];
  *result = local_serialize(reader, queue->slot(state->head), serialized_message);
  if (*result != RMW_RET_BAD_ALLOC) {
    rmw_local_pop(queue, state);
  }
  return true;
}
