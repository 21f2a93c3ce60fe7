/* SPDX-License-Identifier: Apache-2.0 */
/* Every message fits into one datagram, and is kept until it is acknowledged: a ring of messages, each with one sequence
 * number. */
#include "microros/xrce_stream_reliable.h"

#include "microros/xrce_stream_reliable_slots.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

xrce_reliable_slots_t xrce_reliable_slots;

/* Returns the slot of the i-th stored message. */
static uint32_t stream_slot(const xrce_stream_reliable_t * stream, uint8_t i)
{
  const uint32_t slot = (uint32_t)stream->head + i;

  return slot < MICROROS_RELIABLE_SLOTS ? slot : slot - MICROROS_RELIABLE_SLOTS;
}

uint8_t * xrce_stream_reliable_reserve(xrce_stream_reliable_t * stream, xrce_session_t * session)
{
  uint8_t * message;

  if (stream->count == MICROROS_RELIABLE_SLOTS) {
    return NULL;
  }
  message = xrce_reliable_slots.message[stream_slot(stream, stream->count)];
  xrce_stream_reliable_reclaim(session, message);
  return &message[MICROROS_RELIABLE_FRONT];
}

static bool stream_send(xrce_stream_reliable_t * stream, xrce_session_t * session, uint8_t i)
{
  const uint32_t slot = stream_slot(stream, i);
  uint8_t * message = xrce_reliable_slots.message[slot];

  xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_RELIABLE, (uint16_t)(stream->first + i));
  return xrce_transport_take_turn(&session->transport) &&
         xrce_stream_reliable_send(
           session, message, XRCE_MESSAGE_HEADER + (size_t)xrce_reliable_slots.size[slot]);
}

/* Sends new and missing messages in order until the transport accepts no more: the rest waits for the next
 * pump. */
static void stream_flow(xrce_stream_reliable_t * stream, xrce_session_t * session)
{
  for (uint8_t i = 0; (uint32_t)stream->unsent >> i != 0u; ++i) { /* at most MICROROS_RELIABLE_SLOTS rounds */
    const uint32_t bit = (uint32_t)1u << i;

    if ((stream->unsent & bit) != 0u) {
      if (!stream_send(stream, session, i)) {
        return;
      }
      stream->unsent = (uint16_t)(stream->unsent & ~bit);
    }
  }
}

void xrce_stream_reliable_commit(
  xrce_stream_reliable_t * stream, xrce_session_t * session, size_t size, uint32_t now)
{
  const uint8_t i = stream->count;

  xrce_reliable_slots.size[stream_slot(stream, i)] = (uint16_t)size;
  if (i == 0u && !stream->held) {
    xrce_stream_reliable_restart_timer(stream, now);
  }
  stream->count = (uint8_t)(i + 1u);
  if (
    stream->unsent != 0u || session->state != XRCE_READY || stream->held ||
    !stream_send(stream, session, i)) {
    stream->unsent = (uint16_t)(stream->unsent | (uint32_t)1u << i); /* for the next pump */
  }
}

static void stream_free(xrce_stream_reliable_t * stream, uint8_t count)
{
  stream->head = (uint8_t)stream_slot(stream, count);
  stream->first = (uint16_t)(stream->first + count);
  stream->count = (uint8_t)(stream->count - count);
  stream->unsent = (uint16_t)((uint32_t)stream->unsent >> count);
}

void xrce_stream_reliable_hold(xrce_stream_reliable_t * stream, uint32_t now)
{
  stream->first = 0;
  stream->unsent = (uint16_t)(((uint32_t)1u << stream->count) - 1u);
  stream->held = true;
  stream->due_ms = now + XRCE_HELD_MS;
}

static void stream_release(xrce_stream_reliable_t * stream, xrce_session_t * session, uint32_t now)
{
  stream->held = false;
  xrce_stream_reliable_restart_timer(stream, now);
  session->statistics.resent += stream->count;
}

void xrce_stream_reliable_step(
  xrce_stream_reliable_t * stream, xrce_session_t * session, bool settled, uint32_t now)
{
  if (session->state != XRCE_READY) {
    return;
  }
  if (stream->held && (settled || xrce_is_due(now, stream->due_ms))) {
    stream_release(stream, session, now);
  }
  if (stream->count == 0u || stream->held) {
    return;
  }
  stream_flow(stream, session);
  if (stream->unsent == 0u && xrce_is_due(now, stream->due_ms)) {
    (void)xrce_stream_reliable_heartbeat(
      stream, session, stream->count, now); /* the next HEARTBEAT repeats it */
  }
}

bool xrce_stream_reliable_on_acknack(
  xrce_stream_reliable_t * stream, xrce_session_t * session, const uint8_t * payload, size_t size,
  uint8_t flags, uint32_t now)
{
  uint16_t expected;
  uint32_t missing;
  uint16_t place;

  if (size < XRCE_ACKNACK_SIZE) {
    return false;
  }
  if (payload[4] != XRCE_STREAM_RELIABLE || session->state != XRCE_READY || stream->held) {
    return true;
  }
  expected = xrce_get_u16(&payload[0], flags);
  missing = xrce_get_be16(&payload[2]);
  place = (uint16_t)(expected - stream->first);
  if (place <= stream->count) {
    stream_free(stream, (uint8_t)place);
    if (place != 0u) {
      xrce_stream_reliable_restart_timer(stream, now);
    }
    place = 0;
  } else if (missing != 0u) {
    stream->due_ms = now; /* the agent waits for a message of before: send a HEARTBEAT */
  }
  for (; missing != 0u; missing >>= 1) { /* at most 16 rounds */
    if ((missing & 1u) != 0u && place < stream->count && ((uint32_t)stream->unsent >> place & 1u) == 0u) {
      stream->unsent = (uint16_t)(stream->unsent | (uint32_t)1u << place);
      ++session->statistics.resent;
    }
    ++place;
  }
  return true;
}
