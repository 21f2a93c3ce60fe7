/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_parts.h"

#include "microros/xrce_client.h"

#include <string.h>

enum { STREAM_PARTS = 0x82, PART_AT = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER };

static uint32_t parts_left(const xrce_parts_t * parts)
{
  const uint32_t left = parts->size - parts->position;

  return left < MICROROS_PART_SIZE ? left : MICROROS_PART_SIZE;
}

/* Writes the part at `position`, of `size` bytes. The head may be in several parts. */
static void parts_write(const xrce_parts_t * parts, uint8_t * to, uint32_t size)
{
  uint32_t at = parts->position;
  uint32_t done = 0;

  while (at < (uint32_t)XRCE_PARTS_HEAD_SIZE && done < size) {
    to[done] = parts->head[at];
    ++done;
    ++at;
  }
  if (done < size) {
    (void)parts->body(at - (uint32_t)XRCE_PARTS_HEAD_SIZE, size - done, &to[done]);
  }
}

/* Sends the outstanding part; a repetition has the same bytes. */
static void parts_send(xrce_client_t * client, xrce_parts_t * parts, uint32_t now)
{
  const uint32_t size = parts->broken ? 0u : parts_left(parts);
  const bool is_last = parts->broken || parts->position + size == parts->size;
  const uint32_t flags =
    is_last ? XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_LAST_FRAGMENT : XRCE_FLAG_LITTLE_ENDIAN;
  uint8_t message[PART_AT + MICROROS_PART_SIZE];

  xrce_put_header(message, XRCE_SESSION_ID, STREAM_PARTS, parts->sequence);
  xrce_put_submessage(&message[XRCE_MESSAGE_HEADER], XRCE_FRAGMENT, (uint8_t)flags, (uint16_t)size);
  if (size != 0u) {
    parts_write(parts, &message[PART_AT], size);
  }
  parts->due_ms = now + xrce_session_short_pause(now - parts->sent_ms);
  (void)xrce_session_send(&client->session, message, PART_AT + (size_t)size); /* a lost one is repeated */
}

static const xrce_object_state_t * parts_state(const xrce_client_t * client)
{
  return &client->states[MICROROS_NODES_MAX + client->parts.endpoint];
}

/* Sends the next part if the agent has the replier. */
static void parts_go(xrce_client_t * client, xrce_parts_t * parts, uint32_t now)
{
  const xrce_object_state_t * state = parts_state(client);

  if (!state->wanted) { /* it was closed */
    parts->busy = false;
    parts->broken = parts->broken || parts->position != 0u;
  } else if (!state->stale && state->level == (uint8_t)XRCE_SERVICE_COMPLETE) {
    parts->outstanding = true;
    parts->sent_ms = now;
    parts_send(client, parts, now);
  }
}

void xrce_parts_begin(xrce_client_t * client, uint16_t endpoint, const uint8_t * identity)
{
  xrce_parts_t * parts = &client->parts;

  if (parts->busy || parts->body == NULL) {
    return;
  }
  parts->endpoint = endpoint;
  parts->size = (uint32_t)XRCE_PARTS_HEAD_SIZE + parts->body(0u, 0u, NULL);
  xrce_put_submessage(
    parts->head, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(parts->size - XRCE_SUBMESSAGE_HEADER));
  xrce_put_be16(&parts->head[4], XRCE_REQUEST_NONE);
  xrce_put_be16(&parts->head[6], xrce_object_id(endpoint, XRCE_KIND_REPLIER));
  (void)memcpy(&parts->head[XRCE_WRITE_PREFIX], identity, XRCE_IDENTITY_SIZE);
  parts->position = 0;
  parts->busy = true; /* sent by the next step */
}

void xrce_parts_step(xrce_client_t * client, uint32_t now)
{
  xrce_parts_t * parts = &client->parts;

  if (!parts->busy || parts->body == NULL || client->session.state != (uint8_t)XRCE_READY) {
    return;
  }
  if (!parts->outstanding) {
    parts_go(client, parts, now);
  } else if (xrce_is_due(now, parts->due_ms)) {
    parts_send(client, parts, now);
  }
}

/* Called when the agent has the outstanding part. */
static void parts_arrived(xrce_parts_t * parts)
{
  parts->outstanding = false;
  ++parts->sequence;
  if (parts->broken) {
    parts->broken = false;
    return;
  }
  parts->position += parts_left(parts);
  parts->busy = parts->position != parts->size;
}

void xrce_parts_on_acknack(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_parts_t * parts = &client->parts;

  (void)now;
  if (
    size < XRCE_ACKNACK_SIZE || payload[4] != (uint8_t)STREAM_PARTS || !parts->outstanding ||
    client->session.state != (uint8_t)XRCE_READY ||
    xrce_get_u16(&payload[0], xrce_flags_of(submessage)) != (uint16_t)(parts->sequence + 1u)) {
    return;
  }
  parts_arrived(parts); /* the next one is sent by the step that follows: here the stack is deeper */
}

void xrce_parts_renew(xrce_client_t * client)
{
  xrce_parts_t * parts = &client->parts;

  parts->broken = parts->broken || (parts->busy && (parts->outstanding || parts->position != 0u));
  parts->outstanding = false;
  parts->sequence = 0;
  parts->position = 0;
}

void xrce_parts_wake(xrce_client_t * client)
{
  client->parts.body = NULL;
}
