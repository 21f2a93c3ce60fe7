/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_peer_service.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_encode.h"
#include "microros/xrce_client.h"
#include "microros/xrce_peer.h"
#include "microros/xrce_peer_services.h"
#include "microros/xrce_peer_serving.h"
#include "microros/xrce_read.h"
#include "microros/xrce_session.h"
#include "microros/xrce_wire.h"

#include <string.h>

bool rmw_peer_has_room(const xrce_endpoint_t * service, bool * has_room)
{
  xrce_sample_t sample;
  uint8_t link;

  if (!xrce_read_peek(service, &sample) || sample.size < XRCE_IDENTITY_SIZE) {
    return false;
  }
  link = xrce_peer_serving_link(sample.data);
  if (link == (uint8_t)MICROROS_PEERS) {
    return false;
  }
  /* What nobody waits for needs no room. */
  *has_room = !xrce_peer_serving_is_current(service->client, link, sample.data) ||
              (service->client->peers[link].ready && !xrce_peer_serving_keeps_all(service->client, link));
  return true;
}

bool rmw_peer_is_request(const rmw_request_id_t * request)
{
  return xrce_peer_serving_link(request->writer_guid) != (uint8_t)MICROROS_PEERS;
}

bool rmw_peer_keep_room(const rmw_request_id_t * request)
{
  const uint8_t link = xrce_peer_serving_link(request->writer_guid);

  if (link == (uint8_t)MICROROS_PEERS) {
    return false;
  }
  xrce_peer_serving_keep(link);
  return true;
}

bool rmw_peer_free_room(const rmw_request_id_t * request)
{
  const uint8_t link = xrce_peer_serving_link(request->writer_guid);

  if (link == (uint8_t)MICROROS_PEERS) {
    return false;
  }
  xrce_peer_serving_free(link);
  return true;
}

bool rmw_peer_abandon(const rmw_request_id_t * request)
{
  bool result;

  microros_lock();
  result = rmw_peer_free_room(request);
  microros_unlock();
  return result;
}

/* Writes the reply on a link that has room for it. */
static rmw_ret_t peer_reply(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, uint16_t object,
  const uint8_t * identity, const void * ros_response)
{
  const uint8_t link = xrce_peer_serving_link(identity);
  uint8_t * room = xrce_peer_reserve(service->client, link, true);
  size_t end = XRCE_WRITE_PREFIX + XRCE_IDENTITY_SIZE;
  xrce_client_t * client = service->client;
  cdr_fault_t fault; /* set if the message is refused */
  size_t size;

  if (room == NULL) {
    microros_error_set(
      microros_error_peer_busy, service->name, xrce_peer_lines[link].board, client->peers[link].count, 0);
    return RMW_RET_ERROR;
  }
  size = sent->encode(ros_response, &room[end], &fault);
  if (size == 0u) {
    return rmw_encode_refuse(sent, &fault);
  }
  end += size;
  (void)memcpy(&room[XRCE_WRITE_PREFIX], identity, XRCE_IDENTITY_SIZE);
  xrce_put_submessage(
    room, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(end - XRCE_SUBMESSAGE_HEADER));
  xrce_put_be16(&room[4], XRCE_REQUEST_NONE);
  xrce_put_be16(&room[6], object);
  (void)xrce_peer_commit(client, link, true, end, port_time_ms()); /* it stays until it is acknowledged */
  return RMW_RET_OK;
}

rmw_ret_t rmw_peer_respond(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const uint8_t * identity,
  const void * ros_response)
{
  const uint8_t link = xrce_peer_serving_link(identity);
  const uint16_t object =
    xrce_peer_serving_object(link, (uint16_t)(MICROROS_NODES_MAX + service->index - XRCE_REPLIERS_AT));
  xrce_client_t * client = service->client;

  xrce_session_step_all(client);
  if (object == XRCE_PEER_NO_OBJECT || !xrce_peer_serving_is_current(client, link, identity)) {
    ++client->session.statistics.dropped;
    return RMW_RET_OK;
  }
  if (!client->peers[link].ready) {
    microros_error_set(microros_error_peer_silent, service->name, xrce_peer_lines[link].board, 0, 0);
    return RMW_RET_ERROR;
  }
  return peer_reply(service, sent, object, identity, ros_response);
}
