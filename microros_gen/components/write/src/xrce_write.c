/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_write.h"

#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_gate.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_written.h"

#include <string.h>

/* Size of everything before the body in a submessage. */
enum { WRITE_BODY_OFFSET = XRCE_SUBMESSAGE_HEADER + XRCE_OBJECT_PREFIX };

/* Longest time of publishing without reading: well below the time after which a session counts as lost. */
enum { PAUSE_MS = 250, PAUSE_CONNECTING_MS = 10 };

static bool write_is_reliable(const xrce_endpoint_t * writer)
{
  return (writer->qos & XRCE_QOS_RELIABLE) != 0u;
}

/* Returns the number of objects of a complete writer, replier or requester. */
static uint8_t write_complete(const xrce_endpoint_t * writer)
{
  return xrce_place_is_service((uint32_t)MICROROS_NODES_MAX + writer->index)
           ? (uint8_t)XRCE_SERVICE_COMPLETE
           : (uint8_t)XRCE_ENDPOINT_COMPLETE;
}

static bool write_has_session(const xrce_endpoint_t * writer)
{
  return writer->client->session.state == XRCE_READY &&
         writer->client->states[MICROROS_NODES_MAX + writer->index].level == write_complete(writer);
}

uint8_t * xrce_write_reserve(const xrce_endpoint_t * writer)
{
  return write_has_session(writer) ? xrce_route_reserve(writer->client, write_is_reliable(writer)) : NULL;
}

xrce_write_t xrce_write_failure(const xrce_endpoint_t * writer)
{
  if (!write_has_session(writer)) {
    return XRCE_WRITE_NO_SESSION;
  }
  return xrce_output_queue_exists() && !write_is_reliable(writer) ? XRCE_WRITE_NOT_SENT : XRCE_WRITE_FULL;
}

/*
 * Pumps, if it is the turn of the calling task. A waiting read function of the application is skipped for a while if there
 * is room: a publish does not wait.
 */
static uint8_t * write_pump(const xrce_endpoint_t * writer)
{
  xrce_session_t * session = &writer->client->session;
  const uint32_t pause_ms = session->state == XRCE_READY ? PAUSE_MS : PAUSE_CONNECTING_MS;

  if (!xrce_turn_begin(writer->client)) {
    return xrce_write_reserve(writer);
  }
  if (xrce_transport_may_skip_reading(&session->transport, pause_ms)) {
    uint8_t * room;

    xrce_session_step_all(writer->client);
    room = xrce_write_reserve(writer);
    if (room != NULL) {
      return room;
    }
  }
  xrce_session_pump(writer->client);
  return xrce_write_reserve(writer);
}

/* Pumps; returns XRCE_WRITTEN with the room for a submessage, or why there is no room. */
static xrce_write_t write_begin(xrce_endpoint_t * writer, uint8_t ** room)
{
  if (!xrce_gate_is_open(writer)) {
    xrce_session_pump(writer->client);
    xrce_drops_add(writer->client, writer->index);
    return XRCE_WRITE_DROPPED;
  }
  *room = write_pump(writer);
  return *room != NULL ? XRCE_WRITTEN : xrce_write_on_full(writer, room);
}

static xrce_write_t write_end(xrce_endpoint_t * writer, uint8_t * room, size_t size)
{
  xrce_client_t * client = writer->client;

  xrce_put_submessage(room, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(XRCE_OBJECT_PREFIX + size));
  xrce_put_be16(&room[4], XRCE_REQUEST_NONE);
  xrce_put_be16(&room[6], xrce_object_id(writer->index, XRCE_KIND_DATAWRITER));
  if (!xrce_route_commit(client, write_is_reliable(writer), WRITE_BODY_OFFSET + size)) {
    return xrce_write_on_unsent(writer, WRITE_BODY_OFFSET + size);
  }
  xrce_written(writer);
  return XRCE_WRITTEN;
}

xrce_write_t xrce_write_message(xrce_endpoint_t * writer, const void * message, cdr_fault_t * fault)
{
  uint8_t * room;
  size_t size;
  const xrce_write_t outcome = write_begin(writer, &room);

  if (outcome != XRCE_WRITTEN) {
    return outcome;
  }
  size = (size_t)writer->type->encode(message, &room[WRITE_BODY_OFFSET], fault);
  return size == 0u ? XRCE_WRITE_REFUSED : write_end(writer, room, size);
}

xrce_write_t xrce_write_body(xrce_endpoint_t * writer, const uint8_t * body, size_t size)
{
  uint8_t * room;
  const xrce_write_t outcome = write_begin(writer, &room);

  if (outcome != XRCE_WRITTEN) {
    return outcome;
  }
  /* at most MICROROS_RELIABLE_SLOT_SIZE + MICROROS_MTU or MICROROS_MTU bytes */
  (void)memcpy(&room[WRITE_BODY_OFFSET], body, size);
  return write_end(writer, room, size);
}
