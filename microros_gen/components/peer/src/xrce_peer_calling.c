/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_peer_calling.h"

#include "microros/xrce_client.h"
#include "microros/xrce_peer_services.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

static const xrce_queue_t * calling_queue(uint16_t requester)
{
  return &xrce_queues[XRCE_REQUESTERS_AT - XRCE_READERS_AT + requester];
}

/* Returns the i-th request of a client without a reply, or XRCE_REQUEST_NONE. The queues of clients come last. */
static uint16_t calling_request(const xrce_client_t * client, uint16_t requester, uint8_t i)
{
  return client->requests[calling_queue(requester)->first - calling_queue(0)->first + i].request;
}

static bool calling_waits_for(const xrce_client_t * client, uint16_t requester, uint16_t number)
{
  /* at most MICROROS_QUEUE_SLOTS rounds */
  for (uint8_t i = 0; i < calling_queue(requester)->slots; ++i) {
    if (calling_request(client, requester, i) == number) {
      return number != XRCE_REQUEST_NONE;
    }
  }
  return false;
}

const xrce_peer_service_t * xrce_peer_calling_route(uint16_t requester)
{
  for (uint16_t i = 0; i < (uint16_t)MICROROS_PEER_REQUESTERS; ++i) {
    if (xrce_peer_requesters[i].endpoint == requester) {
      return &xrce_peer_requesters[i];
    }
  }
  return NULL;
}

/* Returns the number of the request that a reply answers; XRCE_REQUEST_NONE: one of another session. */
static uint16_t calling_number(const xrce_client_t * client, uint8_t index, const xrce_peer_data_t * data)
{
  const uint8_t * identity = &data->input[data->at];
  const bool is_little = (data->flags & XRCE_FLAG_LITTLE_ENDIAN) != 0u;

  if (data->size <= XRCE_IDENTITY_SIZE || !xrce_peer_services_is_key(identity, client->peers[index].key)) {
    return XRCE_REQUEST_NONE;
  }
  return is_little ? xrce_get_le16(&identity[XRCE_PEER_LOW_AT])
                   : xrce_get_be16(&identity[XRCE_PEER_LOW_AT + 2]);
}

/* Puts number and object of a request in front of the body of its reply, instead of the identity, and stores it. */
static void calling_keep(
  xrce_client_t * client, uint16_t requester, uint16_t number, xrce_peer_data_t * data, uint32_t now)
{
  const uint16_t place = (uint16_t)(XRCE_REQUESTERS_AT + requester);

  data->at += (size_t)XRCE_IDENTITY_SIZE - (size_t)XRCE_RELATED_SIZE;
  data->size -= (size_t)XRCE_IDENTITY_SIZE - (size_t)XRCE_RELATED_SIZE;
  xrce_put_be16(&data->input[data->at], number);
  xrce_put_be16(
    &data->input[data->at + 2u], xrce_object_id((uint16_t)(place - MICROROS_NODES_MAX), XRCE_KIND_REQUESTER));
  xrce_peer_services_keep(client, (uint16_t)(place - XRCE_READERS_AT), data, now);
}

bool xrce_peer_calling_take(xrce_client_t * client, uint8_t index, uint8_t * input, size_t at, uint32_t now)
{
  bool is_reply = false;
  xrce_peer_data_t data;
  uint16_t number;

  if (!xrce_peer_services_read(&data, input, at)) {
    return false;
  }
  number = calling_number(client, index, &data);
  for (uint16_t i = 0; i < (uint16_t)MICROROS_PEER_REQUESTERS; ++i) {
    const xrce_peer_service_t * route = &xrce_peer_requesters[i];

    if (route->link == index && xrce_object_id(route->service, XRCE_KIND_REPLIER) == data.object) {
      is_reply = true;
      if (calling_waits_for(client, route->endpoint, number)) {
        calling_keep(client, route->endpoint, number, &data, now);
        return true;
      }
    }
  }
  if (is_reply) {
    ++client->session.statistics.dropped; /* nobody waits for it any more */
  }
  return is_reply;
}

void xrce_peer_calling_renew(xrce_client_t * client, uint8_t index)
{
  for (uint16_t i = 0; i < (uint16_t)MICROROS_PEER_REQUESTERS; ++i) {
    const uint16_t requester = xrce_peer_requesters[i].endpoint;

    /* at most MICROROS_QUEUE_SLOTS rounds */
    for (uint8_t slot = 0; slot < calling_queue(requester)->slots; ++slot) {
      if (
        xrce_peer_requesters[i].link == index &&
        calling_request(client, requester, slot) != XRCE_REQUEST_NONE) {
        ++client->requesters[requester].interrupted;
        ++client->requesters[requester].unreported;
      }
    }
  }
}
