/* SPDX-License-Identifier: Apache-2.0 */
/* What the stream does with every kind of storage. */
#include "microros/xrce_mark.h"
#include "microros/xrce_stream_reliable.h"
#include "microros/xrce_wire.h"

enum { HEARTBEAT_SIZE = 13 };

/*
 * Waits for a part of the stream. Messages keep their order, and one that is dropped only moves those after it forward: so
 * what is waited for are always the first `left` numbers, and never more than those of the stored messages. A new session
 * gives other numbers to what is stored, and repeats the messages that were acknowledged in part. What was acknowledged
 * between the last look and the loss is not known; then the wait is for as many of the stored messages, which is too long by
 * at most the slots of the stream.
 */
static uint32_t mark_left(
  const xrce_stream_reliable_t * stream, const xrce_session_t * session, const xrce_mark_t * mark)
{
  const uint32_t passed = (uint16_t)(stream->first - mark->first);

  if (!mark->is_counted) {
    return mark->left;
  }
  if (session->statistics.reconnects != mark->session) {
    return mark->left + mark->again;
  }
  if (mark->left <= passed) {
    return 0;
  }
  return mark->left - passed +
         (session->state == (uint8_t)XRCE_READY ? 0u : (uint32_t)xrce_stream_reliable_again(stream));
}

bool xrce_stream_reliable_has_passed(
  const xrce_stream_reliable_t * stream, const xrce_session_t * session, xrce_mark_t * mark)
{
  const bool is_ready = session->state == (uint8_t)XRCE_READY;
  const uint32_t stored = xrce_stream_reliable_ahead(stream, is_ready);

  if (mark->left != 0u) {
    const uint32_t left = mark_left(stream, session, mark);

    mark->left = left < stored ? left : stored;
    mark->session = session->statistics.reconnects;
    mark->first = stream->first;
    mark->again = xrce_stream_reliable_again(stream);
    mark->is_counted = is_ready && !stream->held;
  }
  return mark->left == 0u;
}

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
