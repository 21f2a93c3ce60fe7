/* SPDX-License-Identifier: Apache-2.0 */
/*
 * on_full: drop_oldest, and every message fits into one datagram. A message gets its sequence number when it is
 * first sent. What waits for the line has none yet, so a newer message can replace it without a gap on the wire, and
 * nobody has to know. One slot is left for such a message, as long as there are two: on a line that is always full,
 * what was sent is therefore never dropped, and what is dropped was never sent.
 */
#include "microros/xrce_stream_reliable.h"

#include "microros/xrce_stream_reliable_slots.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

xrce_reliable_slots_t xrce_reliable_slots;

/* Returns the slot of the i-th stored message; free slots follow after them. */
static uint8_t stream_slot(uint8_t i)
{
  return xrce_reliable_slots.order[i] ^ i;
}

/* Frees the slot of the i-th stored message. */
static void stream_remove(xrce_stream_reliable_t * stream, uint8_t i)
{
  const uint8_t slot = stream_slot(i);

  --stream->count;
  for (; i < stream->count; ++i) { /* at most MICROROS_RELIABLE_SLOTS rounds */
    xrce_reliable_slots.order[i] = (uint8_t)(stream_slot((uint8_t)(i + 1u)) ^ i);
  }
  xrce_reliable_slots.order[i] = slot ^ i;
}

/* Retires the first sequence number and its message, which was sent. */
static void stream_pass(xrce_stream_reliable_t * stream)
{
  stream_remove(stream, 0);
  ++stream->first;
  --stream->sent;
  stream->again = (uint16_t)((uint32_t)stream->again >> 1);
  stream->unsent = (uint16_t)((uint32_t)stream->unsent >> 1);
}

uint8_t * xrce_stream_reliable_reserve(xrce_stream_reliable_t * stream, xrce_session_t * session)
{
  (void)session;
  if (stream->count == MICROROS_RELIABLE_SLOTS) {
    return NULL;
  }
  return &xrce_reliable_slots.message[stream_slot(stream->count)][MICROROS_RELIABLE_FRONT];
}

static bool stream_send(xrce_stream_reliable_t * stream, xrce_session_t * session, uint8_t i)
{
  const uint8_t slot = stream_slot(i);
  uint8_t * message = xrce_reliable_slots.message[slot];

  xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_RELIABLE, (uint16_t)(stream->first + i));
  return xrce_transport_take_turn(&session->transport) &&
         xrce_session_send(session, message, XRCE_MESSAGE_HEADER + (size_t)xrce_reliable_slots.size[slot]);
}

/* Sends the numbers that are still available: the agent no longer waits for earlier ones. Without any, the number of the
 * next message, which is on its way. */
static bool stream_announce(xrce_stream_reliable_t * stream, xrce_session_t * session, uint32_t now)
{
  stream->again = 0;
  stream->gap = !xrce_stream_reliable_heartbeat(stream, session, stream->sent != 0u ? stream->sent : 1u, now);
  return !stream->gap;
}

/* Repeats missing messages; returns whether the transport accepted all of them. Nothing may follow that tells whether they
 * arrived, so a HEARTBEAT asks. */
static bool stream_repeat(xrce_stream_reliable_t * stream, xrce_session_t * session, uint32_t now)
{
  for (uint8_t i = 0; (uint32_t)stream->unsent >> i != 0u; ++i) { /* at most MICROROS_RELIABLE_SLOTS rounds */
    const uint32_t bit = (uint32_t)1u << i;

    if ((stream->unsent & bit) != 0u) {
      if (!stream_send(stream, session, i)) {
        return false;
      }
      stream->unsent = (uint16_t)(stream->unsent & ~bit);
      stream->due_ms = now;
    }
  }
  return true;
}

/* Sends a HEARTBEAT over a gap, then missing and new messages, in order, until the transport accepts no more: the rest
 * waits for the next pump. */
static void stream_flow(xrce_stream_reliable_t * stream, xrce_session_t * session, uint32_t now)
{
  if ((stream->gap && !stream_announce(stream, session, now)) || !stream_repeat(stream, session, now)) {
    return;
  }
  /* What xrce_stream_reliable_has_new says: the bound of a loop belongs to its own line. */
  /* at most MICROROS_RELIABLE_BEGUN rounds */
  while (stream->sent < stream->count && stream->sent < (uint32_t)MICROROS_RELIABLE_BEGUN &&
         stream_send(stream, session, stream->sent)) {
    if (stream->sent == 0u) {
      xrce_stream_reliable_restart_timer(stream, now);
    }
    ++stream->sent;
  }
}

void xrce_stream_reliable_commit(
  xrce_stream_reliable_t * stream, xrce_session_t * session, size_t size, uint32_t now)
{
  const bool waits = stream->unsent != 0u || xrce_stream_reliable_has_new(stream);

  xrce_reliable_slots.size[stream_slot(stream->count)] = (uint16_t)size;
  ++stream->count;
  if (session->state == XRCE_READY && !stream->held && !waits) {
    stream_flow(stream, session, now);
  }
}

const uint8_t * xrce_stream_reliable_drop_oldest(
  xrce_stream_reliable_t * stream, const xrce_session_t * session, uint32_t now)
{
  const uint8_t * dropped;

  (void)now;
  if (stream->count == 0u) {
    return NULL;
  }
  if (session->state != XRCE_READY) {
    stream->sent = 0; /* all get other numbers in the next session */
    stream->unsent = 0;
  }
  if (stream->sent == stream->count) {
    if (stream->count < MICROROS_RELIABLE_SLOTS) {
      return NULL; /* the others are reserved: what was sent stays */
    }
    dropped = xrce_reliable_slots.message[stream_slot(0)];
    stream_pass(stream);
    stream->gap = true;
  } else {
    dropped = xrce_reliable_slots.message[stream_slot(stream->sent)];
    stream_remove(stream, stream->sent);
  }
  return &dropped[MICROROS_RELIABLE_FRONT];
}

void xrce_stream_reliable_hold(xrce_stream_reliable_t * stream, uint32_t now)
{
  stream->first = 0;
  stream->sent = 0;
  stream->again = 0;
  stream->unsent = 0;
  stream->gap = false;
  stream->held = true;
  stream->due_ms = now + XRCE_HELD_MS;
}

void xrce_stream_reliable_step(
  xrce_stream_reliable_t * stream, xrce_session_t * session, bool settled, uint32_t now)
{
  if (session->state != XRCE_READY) {
    return;
  }
  if (stream->held && (settled || xrce_is_due(now, stream->due_ms))) {
    stream->held = false;
    session->statistics.resent += stream->count;
  }
  if (stream->held) {
    return;
  }
  stream_flow(stream, session, now);
  if (stream->sent != 0u && !xrce_stream_reliable_is_blocked(stream) && xrce_is_due(now, stream->due_ms)) {
    (void)stream_announce(stream, session, now);
  }
}

bool xrce_stream_reliable_on_acknack(
  xrce_stream_reliable_t * stream, xrce_session_t * session, const uint8_t * payload, size_t size,
  uint8_t flags, uint32_t now)
{
  uint16_t place;
  uint32_t missing;

  if (size < XRCE_ACKNACK_SIZE) {
    return false;
  }
  if (payload[4] != XRCE_STREAM_RELIABLE || session->state != XRCE_READY || stream->held) {
    return true;
  }
  place = (uint16_t)(xrce_get_u16(&payload[0], flags) - stream->first);
  missing = xrce_get_be16(&payload[2]);
  if (place <= stream->sent) {
    if (place != 0u) {
      xrce_stream_reliable_restart_timer(stream, now);
    }
    for (; place != 0u; --place) { /* at most MICROROS_RELIABLE_BEGUN rounds */
      stream_pass(stream);
    }
  } else if (missing != 0u) {
    stream->gap = true; /* the agent waits for a dropped message */
  }
  for (; missing != 0u; missing >>= 1) { /* at most 16 rounds */
    /* Every acknowledgement after a gap names it, so each number is repeated once between two HEARTBEATs. */
    if ((missing & 1u) != 0u && place < stream->sent && ((uint32_t)stream->again >> place & 1u) == 0u) {
      stream->again = (uint16_t)(stream->again | (uint32_t)1u << place);
      stream->unsent = (uint16_t)(stream->unsent | (uint32_t)1u << place);
      ++session->statistics.resent;
    }
    ++place;
  }
  return true;
}
