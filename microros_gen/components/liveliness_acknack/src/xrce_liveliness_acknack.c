/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_liveliness_acknack.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

void xrce_liveliness_acknack_reset(xrce_liveliness_acknack_t * liveliness, uint32_t now)
{
  liveliness->since_ms = now;
  liveliness->first = 0;
}

/* Whether there is nothing to acknowledge, or something was. A message that is dropped for a newer one moves
 * the stream on as well, but nobody is heard then. */
static bool liveliness_is_fine(const xrce_client_t * client)
{
  const xrce_stream_reliable_t * stream = &client->reliable;

  if (client->session.state != XRCE_READY || stream->count == 0u || stream->held) {
    return true;
  }
  return stream->first != client->liveliness.first &&
         xrce_is_due(client->session.heard_ms, client->liveliness.since_ms);
}

void xrce_liveliness_acknack_step(xrce_client_t * client, uint32_t now)
{
  xrce_liveliness_acknack_t * liveliness = &client->liveliness;

  if (liveliness_is_fine(client)) {
    liveliness->since_ms = now;
    liveliness->first = client->reliable.first;
  } else if (now - liveliness->since_ms >= MICROROS_LIVELINESS_PERIOD_MS * MICROROS_LIVELINESS_ATTEMPTS) {
    xrce_session_lose(client, now);
  }
}
