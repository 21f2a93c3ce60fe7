/* SPDX-License-Identifier: Apache-2.0 */
/*
 * on_full: drop_oldest. A reliable message replaces the oldest one, also without a session: the newest are
 * sent in the next session. A best-effort message without a session is dropped.
 */
#include "microros/xrce_drops.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"

xrce_write_t xrce_write_on_full(xrce_endpoint_t * writer, uint8_t ** room)
{
  xrce_client_t * client = writer->client;

  if ((writer->qos & XRCE_QOS_RELIABLE) == 0u) {
    xrce_drops_add(client, writer->index);
    return XRCE_WRITE_DROPPED;
  }
  *room = xrce_route_reserve(client, true);
  if (*room == NULL) {
    const uint8_t * dropped = xrce_route_drop_oldest(client);

    if (dropped != NULL) {
      xrce_drops_add(client, xrce_object_index(xrce_get_be16(&dropped[XRCE_SUBMESSAGE_HEADER + 2])));
      *room = xrce_route_reserve(client, true);
    }
  }
  return *room != NULL ? XRCE_WRITTEN : xrce_write_failure(writer);
}

xrce_write_t xrce_write_on_unsent(xrce_endpoint_t * writer, size_t size)
{
  (void)size;
  xrce_drops_add(writer->client, writer->index);
  return XRCE_WRITE_NOT_SENT;
}
