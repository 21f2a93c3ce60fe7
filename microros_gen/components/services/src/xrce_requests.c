/* SPDX-License-Identifier: Apache-2.0 */
/* Outstanding requests: per client as many as its queue has slots, so that every reply has room. */
#include "microros/xrce_client.h"
#include "microros/xrce_read.h"
#include "microros/xrce_services.h"
#include "microros/xrce_wire.h"

#include <string.h>

static uint16_t requests_index(const xrce_endpoint_t * endpoint)
{
  return (uint16_t)(MICROROS_NODES_MAX + endpoint->index - XRCE_REQUESTERS_AT);
}

static const xrce_queue_t * requests_queue(uint16_t index)
{
  return &xrce_queues[XRCE_REQUESTERS_AT - XRCE_READERS_AT + index];
}

/* Returns the entries of a client, one per slot of its queue. The queues of clients come last. */
static xrce_request_t * requests_first(xrce_client_t * client, uint16_t index)
{
  return &client->requests[requests_queue(index)->first - requests_queue(0)->first];
}

xrce_requester_t * xrce_requests_of(const xrce_endpoint_t * endpoint)
{
  return &endpoint->client->requesters[requests_index(endpoint)];
}

void xrce_requests_open(const xrce_endpoint_t * endpoint)
{
  const uint16_t index = requests_index(endpoint);
  xrce_request_t * entries = requests_first(endpoint->client, index);

  (void)memset(xrce_requests_of(endpoint), 0, sizeof(xrce_requester_t));
  (void)memset(entries, 0, requests_queue(index)->slots * sizeof(*entries));
}

/* Returns how many requests a client has sent since this one. */
static uint32_t requests_age(const xrce_requester_t * requester, const xrce_request_t * entry)
{
  return (uint32_t)((uint64_t)requester->sequence & UINT32_MAX) - entry->sequence;
}

int64_t xrce_requests_add(const xrce_endpoint_t * endpoint, uint16_t request)
{
  xrce_requester_t * requester = xrce_requests_of(endpoint);
  const uint16_t index = requests_index(endpoint);
  xrce_request_t * entries = requests_first(endpoint->client, index);
  xrce_request_t * chosen = entries;

  for (uint8_t i = 0; i < requests_queue(index)->slots; ++i) { /* at most MICROROS_REQUESTS_MAX rounds */
    if (entries[i].request == XRCE_REQUEST_NONE || entries[i].request == request) {
      chosen = &entries[i]; /* numbers repeat after 65,526 requests */
      break;
    }
    if (requests_age(requester, &entries[i]) > requests_age(requester, chosen)) {
      chosen = &entries[i];
    }
  }
  if (chosen->request != XRCE_REQUEST_NONE) {
    ++requester->given_up;
  }
  ++requester->sequence;
  chosen->sequence = (uint32_t)((uint64_t)requester->sequence & UINT32_MAX);
  chosen->request = request;
  return requester->sequence;
}

bool xrce_requests_take(const xrce_endpoint_t * endpoint, uint16_t request, int64_t * sequence)
{
  const xrce_requester_t * requester = xrce_requests_of(endpoint);
  const uint16_t index = requests_index(endpoint);
  xrce_request_t * entries = requests_first(endpoint->client, index);

  /* at most MICROROS_REQUESTS_MAX rounds */
  for (uint8_t i = 0; i < requests_queue(index)->slots && request != XRCE_REQUEST_NONE; ++i) {
    if (entries[i].request == request) {
      *sequence = requester->sequence - (int64_t)requests_age(requester, &entries[i]);
      entries[i].request = XRCE_REQUEST_NONE;
      return true;
    }
  }
  return false;
}

void xrce_requests_renew(xrce_client_t * client)
{
  for (uint16_t index = 0; index < MICROROS_CLIENTS_MAX; ++index) {
    xrce_requester_t * requester = &client->requesters[index];
    const xrce_request_t * entries = requests_first(client, index);

    for (uint8_t i = 0; i < requests_queue(index)->slots; ++i) { /* at most MICROROS_REQUESTS_MAX rounds */
      if (
        entries[i].request != XRCE_REQUEST_NONE &&
        !xrce_place_is_local((uint16_t)(XRCE_REQUESTERS_AT + index))) {
        ++requester->interrupted;
        ++requester->unreported;
      }
    }
  }
}
