/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_peer_client.h"

#include "microros/error.h"
#include "microros/port.h"
#include "microros/rmw_encode.h"
#include "microros/xrce_client.h"
#include "microros/xrce_peer.h"
#include "microros/xrce_peer_calling.h"
#include "microros/xrce_peer_serving.h"
#include "microros/xrce_session.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

static const xrce_peer_service_t * peer_route(const xrce_endpoint_t * client)
{
  return xrce_peer_calling_route((uint16_t)(MICROROS_NODES_MAX + client->index - XRCE_REQUESTERS_AT));
}

bool rmw_peer_server(const xrce_endpoint_t * client, bool * is_connected)
{
  const xrce_peer_service_t * route = peer_route(client);

  if (route == NULL) {
    return false;
  }
  *is_connected = client->client->peers[route->link].ready;
  return true;
}

/* Returns room on a link that is connected; otherwise NULL, with a text. */
static uint8_t * peer_room(const xrce_endpoint_t * client, uint8_t link)
{
  const xrce_peer_t * peer = &client->client->peers[link];
  uint8_t * room = xrce_peer_reserve(client->client, link, true);

  if (!peer->ready) {
    microros_error_set(microros_error_peer_silent, client->name, xrce_peer_lines[link].board, 0, 0);
    return NULL;
  }
  if (room == NULL || xrce_peer_serving_keeps_all(client->client, link)) {
    microros_error_set(microros_error_peer_busy, client->name, xrce_peer_lines[link].board, peer->count, 0);
    return NULL;
  }
  return room;
}

rmw_ret_t rmw_peer_send_request(
  const xrce_endpoint_t * endpoint, const microros_message_type_t * sent, const void * ros_request,
  uint16_t * number)
{
  const xrce_peer_service_t * route = peer_route(endpoint);
  xrce_client_t * client = endpoint->client;
  cdr_fault_t fault; /* set if the message is refused */
  uint8_t * room;
  size_t size;

  if (route == NULL) {
    return RMW_RET_ERROR; /* never: the caller has asked */
  }
  xrce_session_step_all(client);
  room = peer_room(endpoint, route->link);
  if (room == NULL) {
    return RMW_RET_ERROR;
  }
  size = sent->encode(ros_request, &room[XRCE_WRITE_PREFIX], &fault);
  if (size == 0u) {
    return rmw_encode_refuse(sent, &fault);
  }
  *number = xrce_session_next_request(&client->session);
  xrce_put_submessage(room, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(XRCE_OBJECT_PREFIX + size));
  xrce_put_be16(&room[4], *number);
  xrce_put_be16(&room[6], xrce_object_id(route->service, XRCE_KIND_REQUESTER));
  /* it stays until it is acknowledged */
  (void)xrce_peer_commit(client, route->link, true, XRCE_WRITE_PREFIX + size, port_time_ms());
  return RMW_RET_OK;
}
