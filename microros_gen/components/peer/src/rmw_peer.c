/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/links.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_peer_publish.h"
#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_gate.h"
#include "microros/xrce_peer.h"
#include "microros/xrce_peer_serving.h"
#include "microros/xrce_session.h"
#include "microros/xrce_wire.h"
#include "rmw/types.h"

#include <stddef.h>
#include <string.h>

/* A message of the application, or with `body` its `size` encoded bytes. */
typedef struct peer_sample_t {
  const void * message;
  const uint8_t * body;
  size_t size;
} peer_sample_t;

intptr_t microros_link_handle(int link)
{
  const xrce_peer_port_t * port = &xrce_peer_ports[link];
  intptr_t handle;

  microros_lock();
  handle = port->is_open ? xrce_transport_handle(&port->transport) : -1;
  microros_unlock();
  return handle;
}

bool rmw_peer_has_route(const xrce_endpoint_t * writer)
{
  for (uint8_t link = 0; link < MICROROS_PEERS; ++link) {
    const xrce_peer_line_t * line = &xrce_peer_lines[link];

    for (uint16_t i = 0; i < line->writer_count; ++i) { /* at most MICROROS_PUBLISHERS_MAX rounds */
      if (line->writers[i].endpoint == writer->index) {
        return true;
      }
    }
  }
  return false;
}

/* Puts the body of WRITE_DATA; returns its size, 0 and *result if it was refused. */
static size_t peer_put_body(
  const xrce_endpoint_t * writer, const peer_sample_t * sample, uint8_t * at, size_t capacity,
  rmw_ret_t * result)
{
  cdr_fault_t fault; /* set if the message is refused */
  size_t size = sample->size;

  if (sample->body == NULL) {
    size = writer->type->encode(sample->message, at, &fault);
    if (size == 0u) {
      *result = rmw_encode_refuse(writer->type, &fault);
    }
    return size;
  }
  if (size > capacity) {
    microros_error_set(microros_error_serialized, NULL, NULL, (uint32_t)size, (uint32_t)capacity);
    *result = RMW_RET_ERROR;
    return 0;
  }
  (void)memcpy(at, sample->body, size); /* at most MICROROS_PEER_SLOT_SIZE + MICROROS_PEER_MTU bytes */
  return size;
}

/* Sends WRITE_DATA on a link. */
static rmw_ret_t peer_write(
  const xrce_endpoint_t * writer, uint8_t link, uint16_t topic, const peer_sample_t * sample, uint32_t now)
{
  xrce_client_t * client = writer->client;
  const bool reliable = (writer->qos & XRCE_QOS_RELIABLE) != 0u;
  uint8_t * room = xrce_peer_reserve(client, link, reliable);
  rmw_ret_t result = RMW_RET_OK;
  size_t size;

  if (!client->peers[link].ready) {
    microros_error_set(microros_error_peer_absent, writer->name, xrce_peer_lines[link].board, 0, 0);
    return RMW_RET_ERROR;
  }
  if (room == NULL || (reliable && xrce_peer_serving_keeps_all(client, link))) {
    microros_error_set(
      microros_error_peer_full, writer->name, xrce_peer_lines[link].board,
      xrce_peer_serving_unacknowledged(client, link), 0);
    return RMW_RET_ERROR;
  }
  size = peer_put_body(
    writer, sample, &room[XRCE_WRITE_PREFIX], xrce_peer_capacity(link, reliable) - (size_t)XRCE_WRITE_PREFIX,
    &result);
  if (size == 0u) {
    return result;
  }
  xrce_put_submessage(room, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(XRCE_OBJECT_PREFIX + size));
  xrce_put_be16(&room[4], xrce_session_next_request(&client->session));
  xrce_put_be16(&room[6], xrce_object_id(topic, XRCE_KIND_DATAWRITER));
  if (!xrce_peer_commit(client, link, reliable, XRCE_WRITE_PREFIX + size, now)) {
    microros_error_set(
      client->peers[link].lost ? microros_error_peer_lost : microros_error_not_sent, writer->name,
      xrce_peer_lines[link].board, 0, 0);
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
}

/* Sends to every board that subscribes; the others still get what one does not. */
static bool peer_publish(const xrce_endpoint_t * writer, const peer_sample_t * sample, rmw_ret_t * result)
{
  const bool apart = xrce_place_is_local((uint16_t)(MICROROS_NODES_MAX + writer->index));
  const uint32_t now = port_time_ms();

  if (!rmw_peer_has_route(writer)) {
    return false;
  }
  if (!xrce_gate_is_open(writer)) {
    if (apart) {
      xrce_drops_add(writer->client, writer->index); /* of others those who send to the agent count it */
    }
    return apart;
  }
  xrce_session_step_all(writer->client); /* what arrives may be for a task that waits */
  for (uint8_t link = 0; link < MICROROS_PEERS; ++link) {
    const xrce_peer_line_t * line = &xrce_peer_lines[link];

    for (uint16_t i = 0; i < line->writer_count; ++i) { /* at most MICROROS_PUBLISHERS_MAX rounds */
      if (line->writers[i].endpoint == writer->index) {
        const rmw_ret_t outcome = peer_write(writer, link, line->writers[i].topic, sample, now);

        *result = outcome != RMW_RET_OK ? outcome : *result;
      }
    }
  }
  return apart;
}

bool rmw_peer_publish(const xrce_endpoint_t * writer, const void * message, rmw_ret_t * result)
{
  const peer_sample_t sample = {message, NULL, 0};

  return peer_publish(writer, &sample, result);
}

bool rmw_peer_publish_body(
  const xrce_endpoint_t * writer, const uint8_t * body, size_t size, rmw_ret_t * result)
{
  const peer_sample_t sample = {NULL, body, size};

  return peer_publish(writer, &sample, result);
}
