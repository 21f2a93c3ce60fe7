/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_liveliness_acknack.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

void xrce_liveliness_acknack_reset(xrce_liveliness_acknack_t * liveliness, uint32_t now)
{
  liveliness->since_ms = now;
  liveliness->first = 0;
}

/* Returns whether nothing is unacknowledged, or an acknowledgement arrived. A message dropped for a newer
 * one also advances the stream, but is no sign of life. */
static bool liveliness_is_fine(const xrce_client_t * client)
{
  const xrce_stream_reliable_t * stream = &client->reliable;

  const bool waits = stream->count != 0u && !stream->held;

  if (client->session.state != XRCE_READY || !waits) {
    return true;
  }
  return stream->first != client->liveliness.first &&
         client->session.received_ms != client->liveliness.received_ms;
}

void xrce_liveliness_acknack_step(xrce_client_t * client, uint32_t now)
{
  xrce_liveliness_acknack_t * liveliness = &client->liveliness;

  if (liveliness_is_fine(client)) {
    liveliness->since_ms = now;
    liveliness->first = client->reliable.first;
    liveliness->received_ms = client->session.received_ms;
  } else if (xrce_is_due(now, xrce_liveliness_acknack_due(liveliness))) {
    xrce_session_mark_lost(client, now);
  }
}
