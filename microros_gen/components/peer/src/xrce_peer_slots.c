/* SPDX-License-Identifier: Apache-2.0 */
/* No message is larger than the MTU of its link. */
#include "microros/xrce_peer_slots.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

static uint8_t peer_slots[MICROROS_PEERS][MICROROS_PEER_SLOTS][MICROROS_PEER_SLOT_SIZE];
static uint16_t peer_sizes[MICROROS_PEERS][MICROROS_PEER_SLOTS];

/* Returns the slot of the i-th message that waits; the free ones follow. */
static uint8_t slots_at(const xrce_peer_t * peer, uint8_t i)
{
  const uint32_t slot = (uint32_t)peer->head + i;

  return (uint8_t)(slot < MICROROS_PEER_SLOTS ? slot : slot - MICROROS_PEER_SLOTS);
}

size_t xrce_peer_slots_capacity(uint8_t index)
{
  const size_t most = xrce_peer_lines[index].mtu;

  return (most > MICROROS_PEER_SLOT_SIZE ? MICROROS_PEER_SLOT_SIZE : most) - (size_t)XRCE_MESSAGE_HEADER;
}

uint8_t * xrce_peer_slots_room(const xrce_peer_t * peer, uint8_t index)
{
  return &peer_slots[index][slots_at(peer, peer->count)][XRCE_MESSAGE_HEADER];
}

void xrce_peer_slots_put(xrce_peer_t * peer, uint8_t index, size_t size)
{
  peer_sizes[index][slots_at(peer, peer->count)] = (uint16_t)size;
  ++peer->count;
}

uint8_t xrce_peer_slots_window(const xrce_peer_t * peer, uint8_t index)
{
  (void)index;
  return peer->count;
}

bool xrce_peer_slots_send(xrce_client_t * client, uint8_t index, uint8_t place)
{
  const xrce_peer_t * peer = &client->peers[index];
  const uint8_t slot = slots_at(peer, place);
  uint8_t * message = peer_slots[index][slot];

  xrce_put_header(
    message, xrce_peer_own(peer, &xrce_peer_lines[index]), XRCE_STREAM_RELIABLE,
    (uint16_t)(peer->first + place));
  return xrce_peer_send(client, index, message, XRCE_MESSAGE_HEADER + (size_t)peer_sizes[index][slot]);
}

void xrce_peer_slots_free(xrce_peer_t * peer, uint8_t index, uint8_t count)
{
  (void)index;
  peer->head = slots_at(peer, count);
  peer->count = (uint8_t)(peer->count - count);
}
