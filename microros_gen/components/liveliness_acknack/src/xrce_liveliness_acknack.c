/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_liveliness_acknack.h"

#include "microros/xrce_client.h"

void xrce_liveliness_acknack_reset(xrce_liveliness_acknack_t * liveliness, uint32_t now)
{
  liveliness->since_ms = now;
  liveliness->first = 0;
}

void xrce_liveliness_acknack_step(xrce_client_t * client, uint32_t now)
{
  xrce_liveliness_acknack_t * liveliness = &client->liveliness;
  const xrce_stream_reliable_t * stream = &client->reliable;

  if (
    client->session.state != XRCE_READY || stream->count == 0u || stream->held ||
    stream->first != liveliness->first) {
    liveliness->since_ms = now;
    liveliness->first = stream->first;
  } else if (now - liveliness->since_ms >= MICROROS_LIVELINESS_PERIOD_MS * MICROROS_LIVELINESS_ATTEMPTS) {
    xrce_session_lose(client, now);
  }
}
