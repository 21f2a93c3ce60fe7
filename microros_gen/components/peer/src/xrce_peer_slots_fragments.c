/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Some messages are larger than the MTU of their link and are sent in fragments. Each is stored once, after room for the
 * headers of a message and of FRAGMENT. For the second fragment and those after it, the headers overwrite the end of the
 * previous one while it is sent; it is restored afterwards. */
#include "microros/xrce_client.h"
#include "microros/xrce_peer_slots.h"
#include "microros/xrce_wire.h"

#include <string.h>

enum { HEADERS = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER };

static uint8_t peer_slots[MICROROS_PEERS][MICROROS_PEER_SLOTS][MICROROS_PEER_SLOT_SIZE];
static uint16_t peer_sizes[MICROROS_PEERS][MICROROS_PEER_SLOTS];

/* Returns the slot of the i-th message that waits; the free ones follow. */
static uint8_t slots_at(const xrce_peer_t * peer, uint8_t i)
{
  const uint32_t slot = (uint32_t)peer->head + i;

  return (uint8_t)(slot < MICROROS_PEER_SLOTS ? slot : slot - MICROROS_PEER_SLOTS);
}

/* Returns the bytes of a message in each of its fragments but the last. */
static uint32_t slots_fragment(uint8_t index)
{
  return (uint32_t)xrce_peer_lines[index].mtu - (uint32_t)HEADERS;
}

static bool slots_is_whole(uint8_t index, uint32_t size)
{
  return size + (uint32_t)XRCE_MESSAGE_HEADER <= xrce_peer_lines[index].mtu;
}

/* Returns how many numbers the i-th message takes. */
static uint32_t slots_numbers(const xrce_peer_t * peer, uint8_t index, uint8_t i)
{
  const uint32_t size = peer_sizes[index][slots_at(peer, i)];

  return slots_is_whole(index, size) ? 1u : (size + slots_fragment(index) - 1u) / slots_fragment(index);
}

size_t xrce_peer_slots_capacity(uint8_t index)
{
  const size_t room = (size_t)MICROROS_PEER_SLOT_SIZE - (size_t)HEADERS;
  const size_t most = (size_t)xrce_peer_largest[index] - (size_t)XRCE_MESSAGE_HEADER;

  return most > room ? room : most;
}

uint8_t * xrce_peer_slots_room(const xrce_peer_t * peer, uint8_t index)
{
  return &peer_slots[index][slots_at(peer, peer->count)][HEADERS];
}

void xrce_peer_slots_put(xrce_peer_t * peer, uint8_t index, size_t size)
{
  peer_sizes[index][slots_at(peer, peer->count)] = (uint16_t)size;
  ++peer->count;
}

uint8_t xrce_peer_slots_window(const xrce_peer_t * peer, uint8_t index)
{
  const uint32_t most = (uint32_t)XRCE_PEER_WINDOW + peer->done;
  uint32_t numbers = 0;

  for (uint8_t i = 0; i < peer->count && numbers < most; ++i) { /* at most MICROROS_PEER_SLOTS rounds */
    numbers += slots_numbers(peer, index, i);
  }
  return (uint8_t)((numbers < most ? numbers : most) - peer->done);
}

static bool slots_send_fragment(
  xrce_client_t * client, uint8_t index, uint8_t slot, uint32_t fragment, uint16_t number)
{
  const uint32_t most = slots_fragment(index);
  const uint32_t left = peer_sizes[index][slot] - fragment * most;
  const bool is_last = left <= most;
  const uint32_t size = is_last ? left : most;
  uint8_t * at = &peer_slots[index][slot][(size_t)fragment * most];
  uint8_t kept[HEADERS];
  bool sent;

  (void)memcpy(kept, at, sizeof(kept));
  xrce_put_header(
    at, xrce_peer_own(&client->peers[index], &xrce_peer_lines[index]), XRCE_STREAM_RELIABLE, number);
  xrce_put_submessage(
    &at[XRCE_MESSAGE_HEADER], XRCE_FRAGMENT,
    is_last ? XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_LAST_FRAGMENT : XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)size);
  sent = xrce_peer_send(client, index, at, (size_t)HEADERS + size);
  (void)memcpy(at, kept, sizeof(kept));
  return sent;
}

bool xrce_peer_slots_send(xrce_client_t * client, uint8_t index, uint8_t place)
{
  const xrce_peer_t * peer = &client->peers[index];
  const uint16_t number = (uint16_t)(peer->first + place);
  uint32_t fragment = (uint32_t)peer->done + place;
  uint8_t slot;
  uint8_t i = 0;

  /* at most MICROROS_PEER_SLOTS rounds: the window ends in one of the messages */
  while (fragment >= slots_numbers(peer, index, i)) {
    fragment -= slots_numbers(peer, index, i);
    ++i;
  }
  slot = slots_at(peer, i);
  if (slots_is_whole(index, peer_sizes[index][slot])) {
    uint8_t * message = &peer_slots[index][slot][HEADERS - XRCE_MESSAGE_HEADER];

    xrce_put_header(message, xrce_peer_own(peer, &xrce_peer_lines[index]), XRCE_STREAM_RELIABLE, number);
    return xrce_peer_send(client, index, message, XRCE_MESSAGE_HEADER + (size_t)peer_sizes[index][slot]);
  }
  return slots_send_fragment(client, index, slot, fragment, number);
}

void xrce_peer_slots_free(xrce_peer_t * peer, uint8_t index, uint8_t count)
{
  uint32_t done = (uint32_t)peer->done + count;

  /* at most MICROROS_PEER_SLOTS rounds */
  while (peer->count != 0u && done >= slots_numbers(peer, index, 0)) {
    done -= slots_numbers(peer, index, 0);
    peer->head = slots_at(peer, 1);
    --peer->count;
  }
  peer->done = (uint16_t)done;
}
