/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What this board sends in the session in which it is the client. Reliable messages wait in a ring of slots until they
 * are acknowledged, each with one sequence number; they outlast a session and are sent again in the next one. The
 * streams of the agent's session have their storage once in the image, so these are separate. */
#include "microros/xrce_client.h"
#include "microros/xrce_peer.h"
#include "microros/xrce_peer_alert.h"
#include "microros/xrce_wire.h"

enum { HEARTBEAT_MESSAGE = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER + XRCE_HEARTBEAT_SIZE };

static uint8_t peer_slots[MICROROS_PEERS][MICROROS_PEER_SLOTS][MICROROS_PEER_SLOT_SIZE];
static uint16_t peer_sizes[MICROROS_PEERS][MICROROS_PEER_SLOTS];
static uint8_t peer_message[MICROROS_PEER_MTU]; /* best effort */

/* Returns the slot of the i-th message that waits; the free ones follow. */
static uint8_t peer_slot(const xrce_peer_t * peer, uint8_t i)
{
  const uint32_t slot = (uint32_t)peer->head + i;

  return (uint8_t)(slot < MICROROS_PEER_SLOTS ? slot : slot - MICROROS_PEER_SLOTS);
}

bool xrce_peer_send(xrce_client_t * client, uint8_t index, const uint8_t * message, size_t size)
{
  xrce_peer_port_t * port = &xrce_peer_ports[index];

  if (!port->is_open || !xrce_transport_send(&port->transport, message, size)) {
    return false;
  }
  ++client->session.statistics.sent;
  return true;
}

size_t xrce_peer_capacity(uint8_t index, bool reliable)
{
  const size_t most = xrce_peer_lines[index].mtu;

  return (reliable && most > MICROROS_PEER_SLOT_SIZE ? MICROROS_PEER_SLOT_SIZE : most) -
         (size_t)XRCE_MESSAGE_HEADER;
}

uint8_t * xrce_peer_reserve(const xrce_client_t * client, uint8_t index, bool reliable)
{
  const xrce_peer_t * peer = &client->peers[index];

  if (!reliable) {
    return &peer_message[XRCE_MESSAGE_HEADER];
  }
  if (peer->count == MICROROS_PEER_SLOTS) {
    return NULL;
  }
  return &peer_slots[index][peer_slot(peer, peer->count)][XRCE_MESSAGE_HEADER];
}

/* Sends the i-th message that waits. */
static bool peer_send_slot(xrce_client_t * client, uint8_t index, uint8_t i)
{
  const xrce_peer_t * peer = &client->peers[index];
  const uint8_t slot = peer_slot(peer, i);
  uint8_t * message = peer_slots[index][slot];

  xrce_put_header(
    message, xrce_peer_own(peer, &xrce_peer_lines[index]), XRCE_STREAM_RELIABLE, (uint16_t)(peer->first + i));
  return xrce_peer_send(client, index, message, XRCE_MESSAGE_HEADER + (size_t)peer_sizes[index][slot]);
}

bool xrce_peer_commit(xrce_client_t * client, uint8_t index, bool reliable, size_t size, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];
  const uint8_t i = peer->count;

  if (!reliable) {
    xrce_put_header(
      peer_message, xrce_peer_own(peer, &xrce_peer_lines[index]), XRCE_STREAM_BEST_EFFORT, peer->number);
    ++peer->number;
    return xrce_peer_send(client, index, peer_message, XRCE_MESSAGE_HEADER + size);
  }
  peer_sizes[index][peer_slot(peer, i)] = (uint16_t)size;
  if (i == 0u) {
    peer->due_ms = now + MICROROS_PEER_HEARTBEAT_MS;
  }
  peer->count = (uint8_t)(i + 1u);
  if (peer->unsent != 0u || !peer_send_slot(client, index, i)) {
    peer->unsent = (uint16_t)(peer->unsent | (uint32_t)1u << i); /* for the next pump */
  }
  if (i == 0u || peer->unsent != 0u) {
    xrce_peer_alert(client);
  }
  return true;
}

void xrce_peer_renumber(xrce_peer_t * peer, uint32_t now)
{
  peer->number = 0;
  peer->first = 0;
  peer->unsent = (uint16_t)(((uint32_t)1u << peer->count) - 1u);
  peer->due_ms = now + MICROROS_PEER_HEARTBEAT_MS;
}

void xrce_peer_heartbeat(xrce_client_t * client, uint8_t index)
{
  const xrce_peer_t * peer = &client->peers[index];
  uint8_t message[HEARTBEAT_MESSAGE];

  xrce_put_header(message, xrce_peer_own(peer, &xrce_peer_lines[index]), XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_HEARTBEAT, XRCE_FLAG_LITTLE_ENDIAN, XRCE_HEARTBEAT_SIZE);
  xrce_put_le16(&message[8], peer->first);
  xrce_put_le16(&message[10], (uint16_t)(peer->first + peer->count - 1u));
  message[12] = XRCE_STREAM_RELIABLE;
  (void)xrce_peer_send(client, index, message, sizeof(message)); /* it is repeated */
}

void xrce_peer_flow(xrce_client_t * client, uint8_t index, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];

  if (!peer->ready || peer->count == 0u) {
    return;
  }
  for (uint8_t i = 0; (uint32_t)peer->unsent >> i != 0u; ++i) {
    const uint32_t bit = (uint32_t)1u << i;

    if ((peer->unsent & bit) != 0u) {
      if (!peer_send_slot(client, index, i)) {
        return;
      }
      peer->unsent = (uint16_t)(peer->unsent & ~bit);
    }
  }
  if (xrce_is_due(now, peer->due_ms)) {
    xrce_peer_heartbeat(client, index);
    peer->due_ms = now + MICROROS_PEER_HEARTBEAT_MS;
  }
}

void xrce_peer_acknowledged(
  xrce_peer_t * peer, const uint8_t * payload, size_t size, uint8_t flags, uint32_t now)
{
  uint32_t missing;
  uint16_t freed;

  if (size < XRCE_ACKNACK_SIZE || payload[4] != XRCE_STREAM_RELIABLE || !peer->ready) {
    return;
  }
  freed = (uint16_t)(xrce_get_u16(&payload[0], flags) - peer->first);
  if (freed > peer->count) {
    return; /* overtaken by a later one */
  }
  if (freed != 0u) {
    peer->head = peer_slot(peer, (uint8_t)freed);
    peer->first = (uint16_t)(peer->first + freed);
    peer->count = (uint8_t)(peer->count - freed);
    peer->unsent = (uint16_t)((uint32_t)peer->unsent >> freed);
    peer->due_ms = now + MICROROS_PEER_HEARTBEAT_MS;
  }
  missing = xrce_get_be16(&payload[2]) & (((uint32_t)1u << peer->count) - 1u);
  peer->unsent = (uint16_t)(peer->unsent | missing);
}
