/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_stream_reliable_input.h"

#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_whole.h"
#include "microros/xrce_wire.h"

#include <string.h>

/*
 * An ACKNACK has this many bits, and the agent sends at most this many ahead. Numbers from half of 2^16 on
 * are old. */
enum { ACKNACK_MESSAGE = 13, WINDOW = 16 };

#define HALF 0x8000u /* of the sequence numbers */

void xrce_stream_reliable_input_reset(xrce_stream_reliable_input_t * stream)
{
  (void)memset(stream, 0, sizeof(*stream));
}

/* Returns the messages to request: known, not received, and not requested since the last HEARTBEAT. */
static uint16_t input_missing(const xrce_stream_reliable_input_t * stream)
{
  const uint32_t others =
    (uint32_t)xrce_stream_reliable_input_map(stream) | stream->requested | stream->refused;

  return (uint16_t)(stream->announced & ~others);
}

/* Acknowledges up to the next message, and requests the missing ones after it. */
static void input_acknowledge(xrce_client_t * client)
{
  xrce_stream_reliable_input_t * stream = &client->reliable_input;
  const uint16_t missing = input_missing(stream);
  uint8_t message[ACKNACK_MESSAGE];

  stream->requested = (uint16_t)(stream->requested | missing);
  xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_ACKNACK, XRCE_FLAG_LITTLE_ENDIAN, XRCE_ACKNACK_SIZE);
  xrce_put_le16(&message[8], stream->next);
  xrce_put_be16(&message[10], missing);
  message[12] = XRCE_STREAM_RELIABLE;
  (void)xrce_session_send(&client->session, message, sizeof(message)); /* the agent asks again */
}

/* Returns the map of `count` messages from the next one on. */
static uint16_t input_first(uint16_t count)
{
  const uint32_t map = count < WINDOW ? ((uint32_t)1u << count) - 1u : 0xffffu;

  return (uint16_t)map;
}

/* Messages refused without a slot can be requested now: the gap before them is closed. */
static void input_advance(xrce_stream_reliable_input_t * stream)
{
  ++stream->next;
  stream->announced >>= 1;
  stream->requested = (uint16_t)((uint32_t)(stream->requested & ~(uint32_t)stream->refused) >> 1);
  stream->refused = 0;
}

/* Stores a message that is `ahead` (not 0) in the sequence, or records that there was no room for it. */
static void input_take_early(
  xrce_stream_reliable_input_t * stream, uint16_t ahead, const uint8_t * message, size_t size)
{
  const uint32_t bit = (uint32_t)1u << ahead;

  stream->announced = (uint16_t)(stream->announced | input_first((uint16_t)(ahead + 1u)));
  xrce_stream_reliable_input_keep(stream, (uint16_t)(stream->next + ahead), message, size);
  if ((xrce_stream_reliable_input_map(stream) & bit) == 0u) {
    stream->refused = (uint16_t)(stream->refused | bit);
  }
}

/* Delivers the next message. */
static void input_deliver(xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now)
{
  input_advance(&client->reliable_input);
  (void)xrce_session_take_submessages(client, message, size, now); /* cannot fail: it is complete */
}

/* Delivers stored messages from the next one on. */
static void input_deliver_stored(xrce_client_t * client, uint32_t now)
{
  xrce_stream_reliable_input_t * stream = &client->reliable_input;
  size_t size = 0;
  const uint8_t * message = xrce_stream_reliable_input_kept(stream, stream->next, &size);

  while (message != NULL) { /* at most MICROROS_RELIABLE_INPUT_SLOTS - 1 rounds */
    input_deliver(client, message, size, now);
    message = xrce_stream_reliable_input_kept(stream, stream->next, &size);
  }
}

bool xrce_stream_reliable_input_take(
  xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now)
{
  xrce_stream_reliable_input_t * stream = &client->reliable_input;
  const uint16_t sequence = xrce_get_le16(&message[2]);
  const uint16_t ahead = (uint16_t)(sequence - stream->next);

  if (message[1] != XRCE_STREAM_RELIABLE || !xrce_is_whole(message, size)) {
    return false;
  }
  if (client->session.state != XRCE_READY) {
    return true;
  }
  if (ahead == 0u) {
    input_deliver(client, message, size, now);
    input_deliver_stored(client, now);
  } else if (ahead < WINDOW) {
    input_take_early(stream, ahead, message, size);
  }
  input_acknowledge(client);
  return true;
}

/* Returns whether the next message is stored. */
static bool input_can_deliver(const xrce_stream_reliable_input_t * stream)
{
  return (xrce_stream_reliable_input_map(stream) & 1u) != 0u;
}

void xrce_stream_reliable_input_continue(xrce_client_t * client, uint32_t now)
{
  if (input_can_deliver(&client->reliable_input)) {
    input_deliver_stored(client, now);
    input_acknowledge(client);
  }
}

/* Skips up to `count` unavailable messages, up to one that is stored. */
static void input_skip(xrce_stream_reliable_input_t * stream, uint16_t count)
{
  for (uint16_t left = count; left != 0u && !input_can_deliver(stream); --left) { /* at most WINDOW rounds */
    input_advance(stream);
  }
}

bool xrce_stream_reliable_input_on_heartbeat(
  xrce_client_t * client, const uint8_t * payload, size_t size, uint8_t flags)
{
  xrce_stream_reliable_input_t * stream = &client->reliable_input;
  uint16_t ahead;
  uint16_t known;

  if (size < XRCE_HEARTBEAT_SIZE) {
    return false;
  }
  if (payload[4] != XRCE_STREAM_RELIABLE || client->session.state != XRCE_READY) {
    return true;
  }
  ahead = (uint16_t)(xrce_get_u16(&payload[0], flags) - stream->next);
  if (ahead < HALF) { /* otherwise it has not yet received all acknowledgements */
    if (ahead > WINDOW) {
      return false; /* of another session, or forged */
    }
    input_skip(stream, ahead);
  }
  known = (uint16_t)(xrce_get_u16(&payload[2], flags) - stream->next + 1u);
  stream->announced =
    known < HALF ? input_first(known) : 0u; /* a number beyond these was forged, or overtaken */
  stream->requested = 0;
  stream->refused = 0;
  if (!input_can_deliver(stream)) { /* otherwise xrce_stream_reliable_input_continue acknowledges */
    input_acknowledge(client);
  }
  return true;
}
