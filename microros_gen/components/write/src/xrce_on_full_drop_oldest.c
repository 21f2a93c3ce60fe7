/* SPDX-License-Identifier: Apache-2.0 */
/*
 * on_full: drop_oldest. A reliable message takes the place of the oldest one, also while there is no session:
 * the newest are sent when there is one again. A best-effort message without a session is given up.
 */
#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"

xrce_write_t xrce_write_on_full(xrce_endpoint_t * writer, uint8_t ** room)
{
  xrce_client_t * client = writer->client;

  if ((writer->qos & XRCE_QOS_RELIABLE) == 0u) {
    ++client->session.statistics.dropped;
    return XRCE_WRITE_DROPPED;
  }
  *room = xrce_route_reserve(client, true);
  if (*room == NULL && xrce_route_drop_oldest(client)) {
    ++client->session.statistics.dropped;
    *room = xrce_route_reserve(client, true);
  }
  return *room != NULL ? XRCE_WRITTEN : xrce_write_obstacle(writer);
}
