/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_local.h"

#include "microros/port.h"
#include "microros/rmw_decode.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local_publish.h"
#include "microros/rmw_local_wake.h"
#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_gate.h"

#include <stddef.h>

rmw_local_state_t rmw_local_states[MICROROS_LOCAL_QUEUES];

void rmw_local_open(const xrce_endpoint_t * reader)
{
  const uint16_t subscription = (uint16_t)(reader->index - MICROROS_PUBLISHERS_MAX);
  uint8_t queue = RMW_LOCAL_NONE;

  if (subscription < MICROROS_SUBSCRIPTIONS_MAX) { /* services and clients follow */
    queue = rmw_local_queue_of[subscription];
  }
  if (queue != (uint8_t)RMW_LOCAL_NONE) {
    rmw_local_states[queue].head = 0;
    rmw_local_states[queue].count = 0;
    if (rmw_local_queues[queue].bind != NULL) {
      rmw_local_queues[queue].bind();
    }
  }
}

static void local_drop(xrce_client_t * client, uint16_t subscription)
{
  ++client->receivers[subscription].dropped;
  ++client->session.statistics.dropped;
}

/* Returns a free slot: keep last, a full queue drops its oldest message. */
static uint8_t local_begin(xrce_client_t * client, const rmw_local_queue_t * queue, rmw_local_state_t * state)
{
  uint32_t slot;

  if (state->count == queue->slots) {
    rmw_local_pop(queue, state);
    local_drop(client, queue->subscription);
  }
  slot = (uint32_t)state->head + state->count;
  return (uint8_t)(slot < queue->slots ? slot : slot - queue->slots);
}

static bool local_is_open(const xrce_client_t * client, const rmw_local_queue_t * queue)
{
  return client->states[XRCE_READERS_AT + queue->subscription].wanted;
}

/* Returns whether a publisher may deliver now; what it may not is dropped like what goes to the agent. */
static bool local_may(const xrce_endpoint_t * writer, const rmw_local_route_t * route)
{
  if (route->count == 0u) {
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

static void local_put(
  xrce_client_t * client, const rmw_local_queue_t * queue, rmw_local_state_t * state, const void * message,
  uint32_t now)
{
  const uint8_t slot = local_begin(client, queue, state);

  if (queue->copy(message, queue->slot(slot))) {
    queue->published_ms[slot] = now;
    ++state->count;
  } else {
    local_drop(client, queue->subscription); /* never: its limits are those of the publisher */
  }
}

bool rmw_local_has_route(const xrce_endpoint_t * writer)
{
  return rmw_local_routes[writer->index].count != 0u;
}

bool rmw_local_publish(const xrce_endpoint_t * writer, const void * message, rmw_ret_t * result)
{
  const rmw_local_route_t * route = &rmw_local_routes[writer->index];
  const uint32_t now = port_time_ms();
  cdr_fault_t fault; /* set if the message is refused */

  *result = RMW_RET_OK;
  if (!local_may(writer, route)) {
    return route->only;
  }
  if (writer->type->encoded_size(message, &fault) == 0u) {
    *result = rmw_encode_refuse(writer->type, &fault);
    return true;
  }
  for (const uint8_t * at = route->queues; at != &route->queues[route->count]; ++at) {
    const rmw_local_queue_t * queue = &rmw_local_queues[*at];

    if (local_is_open(writer->client, queue)) {
      local_put(writer->client, queue, &rmw_local_states[*at], message, now);
    }
  }
  rmw_local_wake();
  return route->only;
}

bool rmw_local_publish_body(
  const xrce_endpoint_t * writer, const uint8_t * body, size_t size, rmw_ret_t * result)
{
  const rmw_local_route_t * route = &rmw_local_routes[writer->index];
  xrce_client_t * client = writer->client;

  *result = RMW_RET_OK;
  if (!local_may(writer, route)) {
    return route->only;
  }
  for (const uint8_t * at = route->queues; at != &route->queues[route->count]; ++at) {
    const rmw_local_queue_t * queue = &rmw_local_queues[*at];
    rmw_local_state_t * state = &rmw_local_states[*at];

    if (local_is_open(client, queue)) {
      const microros_message_type_t * type =
        client->endpoints[MICROROS_PUBLISHERS_MAX + queue->subscription].type;
      const uint8_t slot = local_begin(client, queue, state);

      *result = rmw_decode(type, body, (uint32_t)size, false, queue->slot(slot));
      if (*result != RMW_RET_OK) {
        return true;
      }
      queue->published_ms[slot] = port_time_ms();
      ++state->count;
    }
  }
  rmw_local_wake();
  return route->only;
}
