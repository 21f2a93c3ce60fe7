/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Some messages are larger than a datagram and are sent as fragments (OMG DDS-XRCE 1.0, 8.3.5.14). Each
 * message is stored once in its slot. The eight bytes before a fragment, message header and FRAGMENT
 * header, overwrite the end of the previous fragment while this one is sent, and are restored afterwards.
 *
 * An agent joins fragments up to the last one; over a gap or a new session some agents continue to join,
 * others refuse everything up to the next last fragment. Therefore a message is never dropped after one of
 * its fragments was sent, and the first number of a session is an empty last fragment (`ending`): a
 * partial message of the previous session is then shorter than its submessage header says, and the agent
 * discards it.
 */
#include "microros/xrce_stream_reliable.h"

#include "microros/xrce_stream_reliable_slots.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

#include <string.h>

enum {
  FRAGMENT_HEADER = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER,
  FRAGMENT_SIZE = MICROROS_MTU - FRAGMENT_HEADER,
  UNFRAGMENTED_SIZE = MICROROS_MTU - XRCE_MESSAGE_HEADER,
  FRAGMENTS_WINDOW = 16
};

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

/* Returns the number of fragments of the i-th stored message. */
static uint16_t stream_fragments(uint8_t i)
{
  const uint32_t size = xrce_reliable_slots.size[stream_slot(i)];

  return size <= UNFRAGMENTED_SIZE ? 1u : (uint16_t)((size + FRAGMENT_SIZE - 1u) / FRAGMENT_SIZE);
}

uint8_t * xrce_stream_reliable_reserve(xrce_stream_reliable_t * stream, xrce_session_t * session)
{
  (void)session;
  if (stream->count == MICROROS_RELIABLE_SLOTS) {
    return NULL;
  }
  return &xrce_reliable_slots.message[stream_slot(stream->count)][MICROROS_RELIABLE_FRONT];
}

/* Result of sending one sequence number. */
typedef enum stream_outcome_t { STREAM_SENT, STREAM_REFUSED, STREAM_NOTHING } stream_outcome_t;

static stream_outcome_t stream_transmit(xrce_session_t * session, const uint8_t * message, size_t size)
{
  return xrce_transport_take_turn(&session->transport) && xrce_session_send(session, message, size)
           ? STREAM_SENT
           : STREAM_REFUSED;
}

/* Sends `size` bytes after the room for a fragment's header. */
static stream_outcome_t stream_send_fragment(
  xrce_session_t * session, uint8_t * fragment, uint16_t sequence, uint16_t size, bool last)
{
  const uint8_t flags = last ? XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_LAST_FRAGMENT : XRCE_FLAG_LITTLE_ENDIAN;

  xrce_put_header(fragment, XRCE_SESSION_ID, XRCE_STREAM_RELIABLE, sequence);
  xrce_put_submessage(&fragment[XRCE_MESSAGE_HEADER], XRCE_FRAGMENT, flags, size);
  return stream_transmit(session, fragment, FRAGMENT_HEADER + (size_t)size);
}

/* Sends a fragment of the i-th stored message, or the whole message if it fits. */
static stream_outcome_t stream_send_of(
  xrce_session_t * session, uint8_t i, uint16_t fragment, uint16_t sequence)
{
  const uint8_t slot = stream_slot(i);
  uint8_t * at = &xrce_reliable_slots.message[slot][(size_t)fragment * FRAGMENT_SIZE];
  const size_t size = (size_t)xrce_reliable_slots.size[slot] - (size_t)fragment * FRAGMENT_SIZE;
  uint8_t kept[FRAGMENT_HEADER];
  stream_outcome_t outcome;

  if (xrce_reliable_slots.size[slot] <= UNFRAGMENTED_SIZE) {
    at = &at[FRAGMENT_HEADER - XRCE_MESSAGE_HEADER];
    xrce_put_header(at, XRCE_SESSION_ID, XRCE_STREAM_RELIABLE, sequence);
    return stream_transmit(session, at, XRCE_MESSAGE_HEADER + size);
  }
  (void)memcpy(kept, at, sizeof(kept));
  if (size > FRAGMENT_SIZE) {
    outcome = stream_send_fragment(session, at, sequence, FRAGMENT_SIZE, false);
  } else {
    outcome = stream_send_fragment(session, at, sequence, (uint16_t)size, true);
  }
  (void)memcpy(at, kept, sizeof(kept));
  return outcome;
}

/* Sends the message or fragment with the number first + place. */
static stream_outcome_t stream_send_place(
  xrce_stream_reliable_t * stream, xrce_session_t * session, uint16_t place)
{
  const uint16_t sequence = (uint16_t)(stream->first + place);
  uint32_t fragment = (uint32_t)place + stream->done;

  if (stream->ending) {
    if (place == 0u) {
      uint8_t message[FRAGMENT_HEADER];

      return stream_send_fragment(session, message, sequence, 0, true);
    }
    --fragment;
  }
  /* at most MICROROS_RELIABLE_BEGUN rounds */
  for (uint8_t i = 0; i < stream->count && i < MICROROS_RELIABLE_BEGUN; ++i) {
    const uint16_t fragments = stream_fragments(i);

    if (fragment < fragments) {
      return stream_send_of(session, i, (uint16_t)fragment, sequence);
    }
    fragment -= fragments;
  }
  return STREAM_NOTHING;
}

/* Repeats missing numbers until the transport accepts no more. */
static stream_outcome_t stream_repeat(xrce_stream_reliable_t * stream, xrce_session_t * session)
{
  stream_outcome_t outcome = STREAM_SENT;

  /* at most FRAGMENTS_WINDOW rounds */
  for (uint8_t place = 0; outcome == STREAM_SENT && (uint32_t)stream->unsent >> place != 0u; ++place) {
    const uint32_t bit = (uint32_t)1u << place;

    if ((stream->unsent & bit) != 0u) {
      outcome = stream_send_place(stream, session, place);
    }
    if (outcome == STREAM_SENT) {
      stream->unsent = (uint16_t)(stream->unsent & ~bit);
    }
  }
  return outcome;
}

/* Sends as much as the window permits and the transport accepts: the rest waits for the next pump. */
static void stream_flow(xrce_stream_reliable_t * stream, xrce_session_t * session, uint32_t now)
{
  stream_outcome_t outcome;

  if (session->state != XRCE_READY || stream->held) {
    return;
  }
  if (stream->sent == 0u) {
    xrce_stream_reliable_restart_timer(stream, now);
  }
  outcome = stream_repeat(stream, session);
  /* at most FRAGMENTS_WINDOW rounds */
  while (outcome == STREAM_SENT && stream->sent < FRAGMENTS_WINDOW) {
    outcome = stream_send_place(stream, session, stream->sent);
    if (outcome == STREAM_SENT) {
      ++stream->sent;
    }
  }
  stream->blocked = outcome == STREAM_REFUSED;
}

void xrce_stream_reliable_commit(
  xrce_stream_reliable_t * stream, xrce_session_t * session, size_t size, uint32_t now)
{
  xrce_reliable_slots.size[stream_slot(stream->count)] = (uint16_t)size;
  ++stream->count;
  stream_flow(stream, session, now);
}

/* Retires the first `count` numbers. */
static void stream_pass(xrce_stream_reliable_t * stream, uint8_t count)
{
  stream->first = (uint16_t)(stream->first + count);
  stream->sent = (uint8_t)(stream->sent - count);
  stream->again = (uint16_t)((uint32_t)stream->again >> count);
  stream->unsent = (uint16_t)((uint32_t)stream->unsent >> count);
}

/* Handles the acknowledgement of the first `count` numbers, all of which were sent. */
static void stream_free(xrce_stream_reliable_t * stream, uint8_t count)
{
  stream_pass(stream, count);
  if (stream->ending && count != 0u) {
    stream->ending = false;
    --count;
  }
  stream->done = (uint16_t)(stream->done + count);
  /* at most MICROROS_RELIABLE_SLOTS rounds */
  while (stream->count != 0u && stream->done >= stream_fragments(0)) {
    stream->done = (uint16_t)(stream->done - stream_fragments(0));
    stream_remove(stream, 0);
  }
}

/* Returns the first message of which nothing was sent; the number of messages if all were started. */
static uint8_t stream_first_unsent(const xrce_stream_reliable_t * stream)
{
  uint32_t used = (uint32_t)stream->sent + stream->done;
  uint8_t i = 0;

  if (stream->ending && stream->sent != 0u) {
    --used;
  }
  while (i < stream->count && used != 0u) { /* at most MICROROS_RELIABLE_SLOTS rounds */
    const uint16_t fragments = stream_fragments(i);

    used = used > fragments ? used - fragments : 0u;
    ++i;
  }
  return i;
}

const uint8_t * xrce_stream_reliable_drop_oldest(
  xrce_stream_reliable_t * stream, const xrce_session_t * session, uint32_t now)
{
  const uint8_t * dropped;
  uint8_t unsent = 0; /* without a session, sent parts do not count */

  (void)now;
  if (session->state == XRCE_READY) {
    unsent = stream_first_unsent(stream);
  }
  if (unsent == stream->count) {
    return NULL;
  }
  dropped = &xrce_reliable_slots.message[stream_slot(unsent)][MICROROS_RELIABLE_FRONT];
  stream_remove(stream, unsent);
  return dropped;
}

uint32_t xrce_stream_reliable_ahead(const xrce_stream_reliable_t * stream, bool is_ready)
{
  uint32_t numbers = 0;

  if (stream->count == 0u) {
    return 0;
  }
  if (stream->ending || !is_ready) {
    numbers = 1;
  }
  for (uint8_t i = 0; i < stream->count; ++i) { /* at most MICROROS_RELIABLE_SLOTS rounds */
    numbers += stream_fragments(i);
  }
  return is_ready ? numbers - stream->done : numbers;
}

void xrce_stream_reliable_hold(xrce_stream_reliable_t * stream, uint32_t now)
{
  stream->first = 0;
  stream->sent = 0;
  stream->done = 0;
  stream->again = 0;
  stream->unsent = 0;
  stream->blocked = false;
  stream->ending = true;
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
  stream_flow(stream, session, now);
  if (stream->sent != 0u && !stream->held && !stream->blocked && xrce_is_due(now, stream->due_ms)) {
    (void)xrce_stream_reliable_heartbeat(
      stream, session, stream->sent, now); /* the next HEARTBEAT repeats it */
    stream->again = 0;
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
    stream_free(stream, (uint8_t)place);
    if (place != 0u) {
      xrce_stream_reliable_restart_timer(stream, now);
    }
    place = 0;
  } else if (missing != 0u) {
    stream->due_ms = now; /* the agent waits for the dropped message: send a HEARTBEAT */
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
