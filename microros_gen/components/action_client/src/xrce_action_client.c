/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_action_client.h"

#include "microros/xrce_client.h"
#include "microros/xrce_read.h"
#include "microros/xrce_services.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

/* Returns the entry of an outstanding request; NULL: it is not outstanding. */
static xrce_request_t * action_client_find(const xrce_endpoint_t * endpoint, int64_t sequence_number)
{
  const xrce_queue_t * first = &xrce_queues[XRCE_REQUESTERS_AT - XRCE_READERS_AT];
  const xrce_queue_t * queue = &xrce_queues[MICROROS_NODES_MAX + (uint32_t)endpoint->index - XRCE_READERS_AT];
  xrce_request_t * entries = &endpoint->client->requests[queue->first - first->first];
  const uint32_t sequence = (uint32_t)((uint64_t)sequence_number & UINT32_MAX);

  for (uint8_t i = 0; i < queue->slots; ++i) { /* at most MICROROS_REQUESTS_MAX rounds */
    if (entries[i].request != XRCE_REQUEST_NONE && entries[i].sequence == sequence) {
      return &entries[i];
    }
  }
  return NULL;
}

void xrce_action_client_abandon(const xrce_endpoint_t * endpoint, int64_t sequence_number)
{
  xrce_request_t * entry = action_client_find(endpoint, sequence_number);
  xrce_requester_t * requester = xrce_requests_of(endpoint);

  if (entry != NULL) {
    entry->request = XRCE_REQUEST_NONE;
    requester->unreported -= requester->unreported != 0u ? 1u : 0u;
  }
}

bool xrce_action_client_expects(const xrce_endpoint_t * endpoint, int64_t sequence_number)
{
  return action_client_find(endpoint, sequence_number) != NULL;
}
