/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_services.h"

#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"

#include <string.h>

xrce_service_t * xrce_service_of(const xrce_endpoint_t * endpoint)
{
  return &endpoint->client->services[MICROROS_NODES_MAX + endpoint->index - XRCE_REPLIERS_AT];
}

xrce_write_t xrce_service_write(
  xrce_endpoint_t * endpoint, uint16_t request, const uint8_t * identity, const void * message,
  cdr_fault_t * fault)
{
  const uint16_t place = (uint16_t)(MICROROS_NODES_MAX + endpoint->index);
  const uint8_t kind = place < XRCE_REQUESTERS_AT ? (uint8_t)XRCE_KIND_REPLIER : (uint8_t)XRCE_KIND_REQUESTER;
  size_t end = XRCE_SUBMESSAGE_HEADER + XRCE_OBJECT_PREFIX;
  xrce_write_t outcome = XRCE_WRITTEN;
  uint8_t * room;
  size_t size;

  if (xrce_turn_begin(endpoint->client)) {
    xrce_session_pump(endpoint->client);
  }
  room = xrce_write_reserve(endpoint);
  if (room == NULL) {
    outcome = xrce_write_on_full(endpoint, &room);
  }
  if (outcome != XRCE_WRITTEN) {
    return outcome;
  }
  if (identity != NULL) {
    /* at most XRCE_IDENTITY_SIZE bytes */
    (void)memcpy(&room[end], identity, XRCE_IDENTITY_SIZE);
    end += XRCE_IDENTITY_SIZE;
  }
  size = (size_t)xrce_service_of(endpoint)->sent->encode(message, &room[end], fault);
  if (size == 0u) {
    return XRCE_WRITE_REFUSED;
  }
  end += size;
  xrce_put_submessage(
    room, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(end - XRCE_SUBMESSAGE_HEADER));
  xrce_put_be16(&room[4], request);
  xrce_put_be16(&room[6], xrce_object_id(endpoint->index, kind));
  return xrce_route_commit(endpoint->client, true, end) ? XRCE_WRITTEN : XRCE_WRITE_NOT_SENT;
}
