/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_peer_fragments.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* Each link has its own session, so that a message of one may arrive between two fragments of another. */
static uint8_t peer_joined[MICROROS_PEERS][MICROROS_PEER_HEAD + MICROROS_PEER_JOINED];
static uint32_t
  joined_sizes[MICROROS_PEERS]; /* what has arrived of a message; more than the buffer: it is skipped */

/* Where the submessages of a message begin. */
enum { BEGIN = MICROROS_PEER_HEAD + XRCE_MESSAGE_HEADER, ROOM = MICROROS_PEER_JOINED - XRCE_MESSAGE_HEADER };

void xrce_peer_fragments_reset(uint8_t index)
{
  joined_sizes[index] = 0;
}

const uint8_t * xrce_peer_fragments_front(uint8_t index, const uint8_t * submessage)
{
  const bool is_first = submessage[0] == XRCE_FRAGMENT && joined_sizes[index] == 0u &&
                        xrce_get_le16(&submessage[2]) >= (uint16_t)XRCE_WRITE_PREFIX;

  return is_first ? xrce_payload_of(submessage) : submessage;
}

/* Appends a fragment, as far as all of them fit. */
static void fragments_add(uint8_t index, const uint8_t * payload, uint32_t size)
{
  const uint32_t arrived = joined_sizes[index];

  if (arrived > (uint32_t)ROOM || size > (uint32_t)ROOM - arrived) {
    joined_sizes[index] = (uint32_t)ROOM + 1u;
  } else {
    /* at most MICROROS_PEER_JOINED bytes */
    (void)memcpy(&peer_joined[index][(uint32_t)BEGIN + arrived], payload, size);
    joined_sizes[index] = arrived + size;
  }
}

uint8_t * xrce_peer_fragments_join(xrce_client_t * client, uint8_t index, size_t * size)
{
  uint8_t * input = xrce_peer_input(index);
  const uint8_t * submessage = &input[BEGIN];
  uint32_t joined;

  if (submessage[0] != XRCE_FRAGMENT) {
    if (joined_sizes[index] != 0u) {
      ++client->session.statistics.malformed; /* a message without its last fragment */
      joined_sizes[index] = 0;
    }
    return input;
  }
  fragments_add(index, xrce_payload_of(submessage), xrce_get_le16(&submessage[2]));
  if ((xrce_flags_of(submessage) & XRCE_FLAG_LAST_FRAGMENT) == 0u) {
    return NULL;
  }
  joined = joined_sizes[index];
  joined_sizes[index] = 0;
  if (joined > (uint32_t)ROOM) {
    ++client->session.statistics.dropped;
    return NULL;
  }
  *size = (size_t)XRCE_MESSAGE_HEADER + joined;
  if (!xrce_peer_is_whole(&peer_joined[index][MICROROS_PEER_HEAD], *size)) {
    ++client->session.statistics.malformed;
    return NULL;
  }
  return peer_joined[index];
}
