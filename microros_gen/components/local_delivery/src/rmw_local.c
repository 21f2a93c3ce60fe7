/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_local.h"

#include "microros/error.h"
#include "microros/port.h"
#include "microros/rmw_decode.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local_deliver.h"
#include "microros/rmw_local_publish.h"
#include "microros/rmw_local_shared.h"
#include "microros/rmw_local_wake.h"
#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_gate.h"
#include "microros/xrce_local_fresh.h"

#include <stddef.h>

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
