/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_pieces.h"

#include "microros/xrce_client.h"

#include <string.h>

enum {
  STREAM_PIECES = 0x82,
  PIECE_AT = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER,
  HEAD_SIZE = XRCE_WRITE_PREFIX + XRCE_IDENTITY_SIZE
};

/* Writes the bytes of the submessage before its body. */
static void pieces_head(const xrce_pieces_t * pieces, uint8_t * head)
{
  xrce_put_submessage(
    head, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(pieces->size - XRCE_SUBMESSAGE_HEADER));
  xrce_put_be16(&head[4], XRCE_REQUEST_NONE);
  xrce_put_be16(&head[6], xrce_object_id(pieces->endpoint, XRCE_KIND_REPLIER));
  (void)memcpy(&head[XRCE_WRITE_PREFIX], pieces->identity, sizeof(pieces->identity));
}

static uint32_t pieces_left(const xrce_pieces_t * pieces)
{
  const uint32_t left = pieces->size - pieces->position;

  return left < MICROROS_PIECE_SIZE ? left : MICROROS_PIECE_SIZE;
}

/* Writes the piece at `position`, of `size` bytes. */
static void pieces_write(const xrce_pieces_t * pieces, uint8_t * to, uint32_t size)
{
  uint32_t done = 0;

  if (pieces->position < (uint32_t)HEAD_SIZE) {
    uint8_t head[HEAD_SIZE];
    const uint32_t left = (uint32_t)HEAD_SIZE - pieces->position;

    done = left < size ? left : size;
    pieces_head(pieces, head);
    (void)memcpy(to, &head[pieces->position], done);
  }
  if (done < size) {
    (void)pieces->body(pieces->position + done - (uint32_t)HEAD_SIZE, size - done, &to[done]);
  }
}

/* Sends the outstanding piece; a repetition has the same bytes. */
static void pieces_send(xrce_client_t * client, uint32_t now)
{
  xrce_pieces_t * pieces = &client->pieces;
  const uint32_t size = pieces->broken ? 0u : pieces_left(pieces);
  const bool is_last = pieces->broken || pieces->position + size == pieces->size;
  const uint32_t flags =
    is_last ? XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_LAST_FRAGMENT : XRCE_FLAG_LITTLE_ENDIAN;
  uint8_t message[PIECE_AT + MICROROS_PIECE_SIZE];

  xrce_put_header(message, XRCE_SESSION_ID, STREAM_PIECES, pieces->sequence);
  xrce_put_submessage(&message[XRCE_MESSAGE_HEADER], XRCE_FRAGMENT, (uint8_t)flags, (uint16_t)size);
  if (size != 0u) {
    pieces_write(pieces, &message[PIECE_AT], size);
  }
  pieces->due_ms = now + xrce_session_short_pause(now - pieces->sent_ms);
  (void)xrce_session_send(&client->session, message, PIECE_AT + (size_t)size); /* a lost one is repeated */
}

static const xrce_object_state_t * pieces_state(const xrce_client_t * client)
{
  return &client->states[MICROROS_NODES_MAX + client->pieces.endpoint];
}

/* Sends the next piece if the agent has the replier. */
static void pieces_go(xrce_client_t * client, uint32_t now)
{
  xrce_pieces_t * pieces = &client->pieces;
  const xrce_object_state_t * state = pieces_state(client);

  if (!state->wanted) { /* it was closed */
    pieces->busy = false;
    pieces->broken = pieces->broken || pieces->position != 0u;
  } else if (!state->stale && state->level == (uint8_t)XRCE_SERVICE_COMPLETE) {
    pieces->outstanding = true;
    pieces->sent_ms = now;
    pieces_send(client, now);
  }
}

void xrce_pieces_begin(xrce_client_t * client, uint16_t endpoint, const uint8_t * identity)
{
  xrce_pieces_t * pieces = &client->pieces;

  if (pieces->busy) {
    return;
  }
  pieces->endpoint = endpoint;
  (void)memcpy(pieces->identity, identity, sizeof(pieces->identity));
  pieces->size = (uint32_t)HEAD_SIZE + pieces->body(0u, 0u, NULL);
  pieces->position = 0;
  pieces->busy = true; /* sent by the next step */
}

void xrce_pieces_step(xrce_client_t * client, uint32_t now)
{
  const xrce_pieces_t * pieces = &client->pieces;

  if (!pieces->busy || pieces->body == NULL || client->session.state != (uint8_t)XRCE_READY) {
    return;
  }
  if (!pieces->outstanding) {
    pieces_go(client, now);
  } else if (xrce_is_due(now, pieces->due_ms)) {
    pieces_send(client, now);
  }
}

/* Called when the agent has the outstanding piece. */
static void pieces_arrived(xrce_pieces_t * pieces)
{
  pieces->outstanding = false;
  ++pieces->sequence;
  if (pieces->broken) {
    pieces->broken = false;
    return;
  }
  pieces->position += pieces_left(pieces);
  pieces->busy = pieces->position != pieces->size;
}

void xrce_pieces_on_acknack(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_pieces_t * pieces = &client->pieces;

  (void)now;
  if (
    size < XRCE_ACKNACK_SIZE || payload[4] != (uint8_t)STREAM_PIECES || !pieces->outstanding ||
    client->session.state != (uint8_t)XRCE_READY ||
    xrce_get_u16(&payload[0], xrce_flags_of(submessage)) != (uint16_t)(pieces->sequence + 1u)) {
    return;
  }
  pieces_arrived(pieces); /* the next one is sent by the step that follows: here the stack is deeper */
}

void xrce_pieces_renew(xrce_client_t * client)
{
  xrce_pieces_t * pieces = &client->pieces;

  pieces->broken = pieces->broken || (pieces->busy && (pieces->outstanding || pieces->position != 0u));
  pieces->outstanding = false;
  pieces->sequence = 0;
  pieces->position = 0;
}

void xrce_pieces_wake(xrce_client_t * client)
{
  client->pieces.body = NULL;
}
