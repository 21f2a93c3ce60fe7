/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_stream_best_effort.h"

#include "microros/xrce_wire.h"
#include "microros_config.h"

/* The stream of the only client. It is here, and not in the client, so that a changed limit leaves all other
 * sources as they are. */
static struct {
  uint16_t sequence; /* of the next message */
  uint8_t message[MICROROS_BEST_EFFORT_SIZE];
} best_effort;

void xrce_stream_best_effort_reset(void)
{
  best_effort.sequence = 0;
}

uint8_t * xrce_stream_best_effort_reserve(void)
{
  return &best_effort.message[XRCE_MESSAGE_HEADER];
}

bool xrce_stream_best_effort_commit(xrce_session_t * session, size_t size)
{
  xrce_put_header(best_effort.message, XRCE_SESSION_ID, XRCE_STREAM_BEST_EFFORT, best_effort.sequence);
  ++best_effort.sequence;
  return xrce_session_send(session, best_effort.message, XRCE_MESSAGE_HEADER + size);
}
