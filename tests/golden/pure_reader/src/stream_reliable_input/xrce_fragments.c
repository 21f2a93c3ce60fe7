/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_fragments.h"

#include "microros/xrce_client.h"
#include "microros/xrce_read.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* What the first piece begins with: the submessage's header, request id and object id. */
enum { REQUEST_AT = 4, OBJECT_AT = 6, BEGIN_SIZE = 8 };

void xrce_fragments_reset(xrce_fragments_t * fragments)
{
  fragments->size = 0;
  fragments->skipping = false;
}

/* Whether the sample that begins so can be kept; otherwise its reader hears of it. */
static bool fragments_can_keep(xrce_client_t * client, const uint8_t * begin, size_t size)
{
  uint16_t length;

  if (size < BEGIN_SIZE || begin[0] != XRCE_DATA) {
    ++client->session.statistics.malformed;
    return false;
  }
  length = xrce_get_le16(&begin[2]);
  if ((uint32_t)length + XRCE_SUBMESSAGE_HEADER <= MICROROS_REASSEMBLY_SIZE) {
    return true;
  }
  xrce_read_refuse(
    client, xrce_get_be16(&begin[REQUEST_AT]), xrce_get_be16(&begin[OBJECT_AT]),
    (uint16_t)(length - XRCE_OBJECT_PREFIX));
  return false;
}

/* Adds a piece; false: it is none of what is here. */
static bool fragments_add(xrce_client_t * client, const uint8_t * piece, size_t size)
{
  xrce_fragments_t * fragments = &client->fragments;

  if (fragments->size == 0u && !fragments_can_keep(client, piece, size)) {
    return false;
  }
  if (size > (size_t)MICROROS_REASSEMBLY_SIZE - fragments->size) {
    ++client->session.statistics.malformed;
    return false;
  }
  (void)memcpy(&fragments->submessage[fragments->size], piece, size);
  fragments->size = (uint16_t)(fragments->size + size);
  return true;
}

static void fragments_hand_on(xrce_client_t * client, uint32_t now)
{
  const uint8_t * submessage = client->fragments.submessage;
  const size_t length = xrce_get_le16(&submessage[2]);

  if (length + XRCE_SUBMESSAGE_HEADER == client->fragments.size) {
    xrce_read_on_data(client, &submessage[XRCE_SUBMESSAGE_HEADER], length, submessage[1], now);
  } else {
    ++client->session.statistics.malformed;
  }
}

void xrce_fragments_on_piece(
  xrce_client_t * client, const uint8_t * payload, size_t size, uint8_t flags, uint32_t now)
{
  xrce_fragments_t * fragments = &client->fragments;
  const uint16_t number = (uint16_t)(client->reliable_input.next - 1u);

  if ((fragments->size != 0u || fragments->skipping) && number != fragments->next) {
    fragments->skipping = true; /* a piece cannot be had any more */
  }
  fragments->next = (uint16_t)(number + 1u);
  if (!fragments->skipping) {
    fragments->skipping = !fragments_add(client, payload, size);
  }
  if ((flags & XRCE_FLAG_LAST_FRAGMENT) != 0u) {
    if (!fragments->skipping) {
      fragments_hand_on(client, now);
    }
    xrce_fragments_reset(fragments);
  }
}
