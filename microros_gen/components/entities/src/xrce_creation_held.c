/* SPDX-License-Identifier: Apache-2.0 */
/* creation: reliable: the stream holds back the application's messages until STATUS arrives. */
#include "microros/xrce_client.h"
#include "microros/xrce_creation_stream.h"

bool xrce_creation_begin(xrce_client_t * client, uint32_t now)
{
  xrce_stream_reliable_t * stream = &client->reliable;

  if (!stream->held) {
    if (!xrce_stream_reliable_is_idle(stream)) {
      return false; /* the agent has to acknowledge earlier messages first */
    }
    stream->held = true;
    stream->due_ms = now;
  }
  return true;
}
