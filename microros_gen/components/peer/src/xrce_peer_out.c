/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What this board sends in the session in which it is the client. Reliable messages wait in a ring of slots until they
 * are acknowledged; they outlast a session and are sent again in the next one. The
 * streams of the agent's session have their storage once in the image, so these are separate. */
#include "microros/xrce_client.h"
#include "microros/xrce_peer.h"
#include "microros/xrce_peer_find_note.h"
#include "microros/xrce_peer_slots.h"
#include "microros/xrce_turn.h"
#include "microros/xrce_wire.h"

enum { HEARTBEAT_MESSAGE = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER + XRCE_HEARTBEAT_SIZE };

/* An answer that takes longer than a HEARTBEAT's period makes the pause before the next one up to 32 times as long:
 * each HEARTBEAT has everything repeated that is still on its way, and a slow line would fill with copies. */
enum { PAUSES_MOST = 5 };

static uint8_t peer_message[MICROROS_PEER_MTU]; /* best effort */

static uint32_t peer_pause_ms(const xrce_peer_t * peer)
{
  return (uint32_t)MICROROS_PEER_HEARTBEAT_MS << peer->pauses;
}

static void peer_pause(xrce_peer_t * peer, uint32_t now)
{
  peer->due_ms = now + peer_pause_ms(peer);
}

/* Returns whether less than a period has passed since the last HEARTBEAT, or what ended the pause before it. */
static bool peer_is_prompt(const xrce_peer_t * peer, uint32_t now)
{
  return now - (peer->due_ms - peer_pause_ms(peer)) < (uint32_t)MICROROS_PEER_HEARTBEAT_MS;
}

/* Returns the bits of the first `count` numbers, at most 16. */
static uint16_t peer_bits(uint8_t count)
{
  return (uint16_t)(((uint32_t)1u << count) - 1u);
}

bool xrce_peer_send(xrce_client_t * client, uint8_t index, const uint8_t * message, size_t size)
{
  xrce_peer_port_t * port = &xrce_peer_ports[index];
  const bool is_sent = port->is_open && xrce_transport_send(&port->transport, message, size);

  xrce_peer_find_note(index, is_sent);
  if (is_sent) {
    ++client->session.statistics.sent;
  }
  return is_sent;
}

size_t xrce_peer_capacity(uint8_t index, bool reliable)
{
  return reliable ? xrce_peer_slots_capacity(index)
                  : (size_t)xrce_peer_lines[index].mtu - (size_t)XRCE_MESSAGE_HEADER;
}

uint8_t * xrce_peer_reserve(const xrce_client_t * client, uint8_t index, bool reliable)
{
  const xrce_peer_t * peer = &client->peers[index];

  if (!reliable) {
    return &peer_message[XRCE_MESSAGE_HEADER];
  }
  return peer->count == MICROROS_PEER_SLOTS ? NULL : xrce_peer_slots_room(peer, index);
}

/* Sends what has to be sent. Returns false if the line has no room for all of it. */
static bool peer_send_unsent(xrce_client_t * client, uint8_t index)
{
  xrce_peer_t * peer = &client->peers[index];

  for (uint8_t i = 0; (uint32_t)peer->unsent >> i != 0u; ++i) { /* at most 16 rounds */
    const uint32_t bit = (uint32_t)1u << i;

    if ((peer->unsent & bit) != 0u) {
      if (!xrce_peer_slots_send(client, index, i)) {
        return false;
      }
      peer->unsent = (uint16_t)(peer->unsent & ~bit);
    }
  }
  return true;
}

bool xrce_peer_commit(xrce_client_t * client, uint8_t index, bool reliable, size_t size, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];
  const bool is_blocked = peer->unsent != 0u; /* older ones go first, in the next pump */
  uint8_t window;

  if (!reliable) {
    xrce_put_header(
      peer_message, xrce_peer_own(peer, &xrce_peer_lines[index]), XRCE_STREAM_BEST_EFFORT, peer->number);
    ++peer->number;
    return xrce_peer_send(client, index, peer_message, XRCE_MESSAGE_HEADER + size);
  }
  window = xrce_peer_slots_window(peer, index);
  xrce_peer_slots_put(peer, index, size);
  peer->unsent =
    (uint16_t)(peer->unsent | (peer_bits(xrce_peer_slots_window(peer, index)) ^ peer_bits(window)));
  if (window == 0u) {
    peer_pause(peer, now);
  }
  if (is_blocked || !peer_send_unsent(client, index) || window == 0u) {
    xrce_turn_stored(client); /* a HEARTBEAT, or a message that is not sent yet, becomes due */
  }
  return true;
}

void xrce_peer_hurry(xrce_peer_t * peer, uint32_t now)
{
  if (peer->ready) {
    peer->pauses = 0;
    peer_pause(peer, now);
  }
}

void xrce_peer_renumber(xrce_peer_t * peer, uint8_t index, uint32_t now)
{
  peer->number = 0;
  peer->first = 0;
  peer->done = 0;
  peer->unsent = peer_bits(xrce_peer_slots_window(peer, index));
  xrce_peer_hurry(peer, now);
}

void xrce_peer_heartbeat(xrce_client_t * client, uint8_t index)
{
  const xrce_peer_t * peer = &client->peers[index];
  uint8_t message[HEARTBEAT_MESSAGE];

  xrce_put_header(message, xrce_peer_own(peer, &xrce_peer_lines[index]), XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_HEARTBEAT, XRCE_FLAG_LITTLE_ENDIAN, XRCE_HEARTBEAT_SIZE);
  xrce_put_le16(&message[8], peer->first);
  xrce_put_le16(&message[10], (uint16_t)(peer->first + xrce_peer_slots_window(peer, index) - 1u));
  message[12] = XRCE_STREAM_RELIABLE;
  (void)xrce_peer_send(client, index, message, sizeof(message)); /* it is repeated */
}

void xrce_peer_flow(xrce_client_t * client, uint8_t index, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];

  if (!peer->ready || peer->count == 0u) {
    return;
  }
  if (peer_send_unsent(client, index) && xrce_is_due(now, peer->due_ms)) {
    xrce_peer_heartbeat(client, index);
    if (peer->pauses < (uint8_t)PAUSES_MOST) {
      ++peer->pauses;
    }
    peer_pause(peer, now);
  }
}

void xrce_peer_acknowledged(
  xrce_peer_t * peer, uint8_t index, const uint8_t * payload, size_t size, uint8_t flags, uint32_t now)
{
  uint8_t window = xrce_peer_slots_window(peer, index);
  uint16_t missing;
  uint16_t freed;

  if (size < XRCE_ACKNACK_SIZE || payload[4] != XRCE_STREAM_RELIABLE || !peer->ready) {
    return;
  }
  freed = (uint16_t)(xrce_get_u16(&payload[0], flags) - peer->first);
  if (freed > window) {
    return; /* overtaken by a later one */
  }
  window = (uint8_t)(window - freed);
  missing = (uint16_t)(xrce_get_be16(&payload[2]) & peer_bits(window));
  if (freed != 0u) {
    xrce_peer_slots_free(peer, index, (uint8_t)freed);
    peer->first = (uint16_t)(peer->first + freed);
    peer->unsent = (uint16_t)((uint32_t)peer->unsent >> freed);
  }
  /* A board that has yet to open a subscription asks at once for what it does not acknowledge. Answers to copies ask for
   * nothing. */
  if (freed != 0u || (missing != 0u && peer_is_prompt(peer, now))) {
    peer->pauses = (uint8_t)(peer->pauses / 2u);
    peer_pause(peer, now);
  }
  /* Fragments follow for those that are acknowledged. */
  missing = (uint16_t)(missing | (peer_bits(xrce_peer_slots_window(peer, index)) ^ peer_bits(window)));
  peer->unsent = (uint16_t)(peer->unsent | missing);
}
