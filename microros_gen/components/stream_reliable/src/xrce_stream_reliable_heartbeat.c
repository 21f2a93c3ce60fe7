/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_stream_reliable.h"
#include "microros/xrce_wire.h"

enum { HEARTBEAT_SIZE = 13 };

bool xrce_stream_reliable_heartbeat(
  xrce_stream_reliable_t * stream, xrce_session_t * session, uint16_t count, uint32_t now)
{
  const uint32_t pause_ms = xrce_session_short_pause(now - stream->since_ms);
  uint8_t message[HEARTBEAT_SIZE];

  xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_HEARTBEAT, XRCE_FLAG_LITTLE_ENDIAN, HEARTBEAT_SIZE - 8);
  xrce_put_le16(&message[8], stream->first);
  xrce_put_le16(&message[10], (uint16_t)(stream->first + count - 1u));
  message[12] = XRCE_STREAM_RELIABLE;
  stream->due_ms =
    now + (pause_ms > MICROROS_HEARTBEAT_PERIOD_MS ? pause_ms : (uint32_t)MICROROS_HEARTBEAT_PERIOD_MS);
  return xrce_session_send(session, message, sizeof(message));
}
