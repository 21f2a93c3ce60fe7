/* SPDX-License-Identifier: Apache-2.0 */
/*
 * on_full: drop_oldest. A reliable message replaces the oldest one that was not sent, also without a session: the newest
 * are sent in the next session. Slots that are reserved for replies are not used: if what was sent fills the others, the new
 * message is refused. A best-effort message without a session is dropped; with one it replaces the oldest one that
 * waits.
 */
#include "microros/xrce_drops.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"

/* Without a queue there is always room, so it lacks a session. */
static xrce_write_t full_best_effort(xrce_endpoint_t * writer, uint8_t ** room)
{
  xrce_client_t * client = writer->client;

  if (xrce_output_queue_exists() && xrce_write_failure(writer) != XRCE_WRITE_NO_SESSION) {
    const uint8_t * dropped = xrce_output_queue_drop_oldest();

    /* cppcheck-suppress knownConditionTrueFalse ; a queue exists only with tasks of the application file */
    if (dropped != NULL) {
      xrce_drops_add(client, xrce_object_index(xrce_get_be16(&dropped[XRCE_SUBMESSAGE_HEADER + 2])));
      *room = xrce_route_reserve(client, false);
      return XRCE_WRITTEN;
    }
  }
  xrce_drops_add(client, writer->index);
  return XRCE_WRITE_DROPPED;
}

xrce_write_t xrce_write_on_full(xrce_endpoint_t * writer, uint8_t ** room)
{
  xrce_client_t * client = writer->client;

  if ((writer->qos & XRCE_QOS_RELIABLE) == 0u) {
    return full_best_effort(writer, room);
  }
  *room = xrce_route_reserve(client, true);
  while (*room == NULL) { /* at most MICROROS_RELIABLE_SLOTS + 1 rounds */
    const uint8_t * dropped = xrce_route_drop_oldest(client);

    if (dropped == NULL) {
      xrce_drops_add(client, writer->index);
      return xrce_write_failure(writer);
    }
    xrce_drops_add(client, xrce_object_index(xrce_get_be16(&dropped[XRCE_SUBMESSAGE_HEADER + 2])));
    *room = xrce_route_reserve(client, true); /* NULL while slots are reserved for replies */
  }
  return XRCE_WRITTEN;
}

xrce_write_t xrce_write_on_unsent(xrce_endpoint_t * writer, size_t size)
{
  (void)size;
  xrce_drops_add(writer->client, writer->index);
  return XRCE_WRITE_NOT_SENT;
}
