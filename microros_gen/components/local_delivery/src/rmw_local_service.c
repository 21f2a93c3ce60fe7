/* SPDX-License-Identifier: Apache-2.0 */
/* Services between clients and servers of one image, or of two: each has a queue, like a subscription. */
#include "microros/rmw_local_service.h"

#include "microros/error.h"
#include "microros/port.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local.h"
#include "microros/rmw_local_deliver.h"
#include "microros/rmw_local_shared.h"
#include "microros/rmw_local_wake.h"
#include "microros/rmw_shared_call.h"
#include "microros/xrce_client.h"
#include "microros/xrce_local_fresh.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"

#include <stddef.h>
#include <string.h>

/* The identity of a local request in place of a GUID, which never begins with such bytes (0xffff: no vendor). */
enum { LOCAL_MARK = 0xff, LOCAL_MARK_SIZE = 12, LOCAL_CLIENT_AT = 12, LOCAL_NUMBER_AT = 14 };

enum { LOCAL_FIRST_CLIENT = XRCE_REQUESTERS_AT - XRCE_READERS_AT };

static uint8_t local_queue(const xrce_endpoint_t * endpoint)
{
  return rmw_local_queue_of[endpoint->index - MICROROS_PUBLISHERS_MAX];
}

static bool local_has_message(const xrce_endpoint_t * endpoint)
{
  const uint8_t index = local_queue(endpoint);

  return index != (uint8_t)RMW_LOCAL_NONE && rmw_local_states[index].count != 0u;
}

/* A client is told by its send call that nothing can arrive. */
bool rmw_local_waits(const xrce_endpoint_t * endpoint)
{
  return local_has_message(endpoint) ||
         (MICROROS_NODES_MAX + endpoint->index < XRCE_REQUESTERS_AT && rmw_shared_is_wrong(endpoint));
}

/* Returns RMW_RET_ERROR, with a text, for a message above the limits of its type. */
static rmw_ret_t local_check(const microros_message_type_t * sent, const void * message)
{
  cdr_fault_t fault; /* set if the message is refused */

  return sent->encoded_size(message, &fault) == 0u ? rmw_encode_refuse(sent, &fault) : RMW_RET_OK;
}

/* Puts a message into a queue; a full one drops its oldest. */
static void local_put(
  xrce_client_t * client, uint8_t index, const void * message, const rmw_local_origin_t * origin)
{
  const rmw_local_queue_t * queue = &rmw_local_queues[index];
  rmw_local_state_t * state = &rmw_local_states[index];
  const uint8_t slot = rmw_local_begin(client, queue, state);

  if (queue->put(slot, message)) {
    queue->published_ms[slot] = port_time_ms();
    queue->origins[slot] = *origin;
    ++state->count;
  } else {
    rmw_local_drop(client, queue->receiver); /* never: both ends have the same limits */
  }
  xrce_local_fresh = true;
  rmw_local_wake();
}

/* Copies the oldest message of a queue to the caller's and removes it. */
static rmw_ret_t local_get(
  const xrce_endpoint_t * endpoint, uint8_t index, xrce_sample_t * sample, void * message)
{
  const rmw_local_queue_t * queue = &rmw_local_queues[index];

  sample->arrived_ms = queue->published_ms[rmw_local_states[index].head];
  return queue->remove(message)
           ? RMW_RET_OK
           : microros_error_named(RMW_RET_ERROR, microros_error_local_capacity, endpoint->name);
}

/* Returns whether a request of the agent is older, and can be answered now. */
static bool service_agent_first(const xrce_endpoint_t * service, uint8_t index)
{
  const uint32_t sent_ms = rmw_local_queues[index].published_ms[rmw_local_states[index].head];
  xrce_sample_t sample;

  return !rmw_local_queues[index].only && xrce_read_peek(service, &sample) &&
         !xrce_is_due(sample.arrived_ms, sent_ms) && xrce_write_reserve(service) != NULL;
}

bool rmw_local_take_request(
  const xrce_endpoint_t * service, rmw_request_id_t * request, xrce_sample_t * sample, void * ros_request,
  rmw_ret_t * result)
{
  const uint8_t index = local_queue(service);
  const rmw_local_origin_t * origin;

  if (rmw_shared_is_wrong(service)) {
    *result = rmw_shared_report(service);
    return true;
  }
  if (!local_has_message(service) || service_agent_first(service, index)) {
    return false;
  }
  origin = &rmw_local_queues[index].origins[rmw_local_states[index].head];
  (void)memset(request->writer_guid, LOCAL_MARK, LOCAL_MARK_SIZE);
  xrce_put_be16(&request->writer_guid[LOCAL_CLIENT_AT], origin->client);
  xrce_put_be16(&request->writer_guid[LOCAL_NUMBER_AT], origin->number);
  request->sequence_number = origin->sequence;
  *result = local_get(service, index, sample, ros_request);
  return true;
}

bool rmw_local_is_request(const rmw_request_id_t * request)
{
  bool is_local = true;

  for (size_t i = 0; i < (size_t)LOCAL_MARK_SIZE; ++i) {
    is_local = is_local && request->writer_guid[i] == (uint8_t)LOCAL_MARK;
  }
  return is_local;
}

/* Puts a response into the queue of its client if that calls this server and is open. */
static void local_reply(
  const xrce_endpoint_t * service, const rmw_local_origin_t * origin, const void * ros_response)
{
  const uint8_t index = rmw_local_queue_of[LOCAL_FIRST_CLIENT + origin->client];

  if (
    index != (uint8_t)RMW_LOCAL_NONE &&
    rmw_local_server_of[origin->client] ==
      local_queue(service) && /* an identity from outside may name any client */
    rmw_local_is_open(service->client, &rmw_local_queues[index])) {
    local_put(service->client, index, ros_response, origin);
  } else {
    ++service->client->session.statistics.dropped; /* nobody waits for it any more */
  }
}

/* A function, since a comparison with a constant 0 is one that compilers warn about: there may be no client. */
static bool local_is_below(uint16_t client, uint16_t count)
{
  return client < count;
}

rmw_ret_t rmw_local_respond(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const rmw_request_id_t * request,
  const void * ros_response)
{
  const rmw_local_origin_t origin = {
    .client = xrce_get_be16(&request->writer_guid[LOCAL_CLIENT_AT]),
    .number = xrce_get_be16(&request->writer_guid[LOCAL_NUMBER_AT]),
    .sequence = request->sequence_number};
  rmw_ret_t result;

  if (rmw_shared_has_ring(service)) {
    return rmw_shared_call_reply(service, sent, &origin, ros_response);
  }
  result = local_check(sent, ros_response);
  if (result == RMW_RET_OK && local_is_below(origin.client, MICROROS_CLIENTS_MAX)) {
    local_reply(service, &origin, ros_response);
  }
  return result;
}

static uint16_t local_client(const xrce_endpoint_t * client)
{
  return (uint16_t)(MICROROS_NODES_MAX + client->index - XRCE_REQUESTERS_AT);
}

bool rmw_local_server(const xrce_endpoint_t * client, bool * is_open)
{
  const uint8_t index = rmw_local_server_of[local_client(client)];

  if (rmw_shared_has_ring(client)) {
    *is_open = rmw_shared_call_is_open(client);
    return true;
  }
  if (index == (uint8_t)RMW_LOCAL_NONE) {
    return false;
  }
  *is_open = rmw_local_is_open(client->client, &rmw_local_queues[index]);
  return true;
}

rmw_ret_t rmw_local_send_request(
  const xrce_endpoint_t * client, const microros_message_type_t * sent, const rmw_local_number_t * number,
  const void * ros_request)
{
  const rmw_local_origin_t origin = {
    .client = local_client(client), .number = number->request, .sequence = number->sequence};
  const uint8_t index = rmw_local_server_of[origin.client];
  rmw_ret_t result;

  if (rmw_shared_has_ring(client)) {
    return rmw_shared_call_request(client, sent, number, ros_request);
  }
  result = local_check(sent, ros_request);
  if (result != RMW_RET_OK) {
    return result;
  }
  if (!rmw_local_is_open(client->client, &rmw_local_queues[index])) {
    ++client->client->session.statistics.dropped;
    return RMW_RET_OK;
  }
  if (rmw_local_states[index].count == rmw_local_queues[index].slots) {
    return microros_error_named(RMW_RET_ERROR, microros_error_local_full, client->name);
  }
  local_put(client->client, index, ros_request, &origin);
  return RMW_RET_OK;
}

bool rmw_local_find_reply(const xrce_endpoint_t * client, uint16_t * number)
{
  const uint8_t index = local_queue(client);

  if (!local_has_message(client)) {
    return false;
  }
  *number = rmw_local_queues[index].origins[rmw_local_states[index].head].number;
  return true;
}

rmw_ret_t rmw_local_take_reply(const xrce_endpoint_t * client, xrce_sample_t * sample, void * ros_response)
{
  return local_get(client, local_queue(client), sample, ros_response);
}

void rmw_local_discard_reply(const xrce_endpoint_t * client)
{
  const uint8_t index = local_queue(client);

  rmw_local_pop(&rmw_local_queues[index], &rmw_local_states[index]);
  rmw_local_drop(client->client, rmw_local_queues[index].receiver);
}
