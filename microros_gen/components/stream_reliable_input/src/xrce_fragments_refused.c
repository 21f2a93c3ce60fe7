/* SPDX-License-Identifier: Apache-2.0 */
/* No sample of the plan needs fragments. */
#include "microros/xrce_client.h"
#include "microros/xrce_fragments.h"
#include "microros/xrce_read.h"
#include "microros/xrce_wire.h"

/* Start of the first fragment: the submessage's header, request id and object id. */
enum { LENGTH_AT = 2, REQUEST_AT = 4, OBJECT_AT = 6, BEGIN_SIZE = 8 };

void xrce_fragments_reset(xrce_fragments_t * fragments)
{
  fragments->skipping = false;
}

static void fragments_refuse(xrce_client_t * client, const uint8_t * begin, size_t size)
{
  const uint16_t length = size < BEGIN_SIZE ? 0u : xrce_get_le16(&begin[LENGTH_AT]);

  if (length <= XRCE_OBJECT_PREFIX || begin[0] != XRCE_DATA) {
    ++client->session.statistics.malformed;
    return;
  }
  xrce_read_refuse(
    client, xrce_get_be16(&begin[REQUEST_AT]), xrce_get_be16(&begin[OBJECT_AT]),
    (uint16_t)(length - XRCE_OBJECT_PREFIX));
}

void xrce_fragments_on_fragment(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  xrce_fragments_t * fragments = &client->fragments;

  (void)now;
  if (!fragments->skipping) {
    fragments_refuse(client, xrce_payload_of(submessage), size);
  }
  fragments->skipping = (xrce_flags_of(submessage) & XRCE_FLAG_LAST_FRAGMENT) == 0u;
}
