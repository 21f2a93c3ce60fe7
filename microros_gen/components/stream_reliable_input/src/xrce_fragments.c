/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_fragments.h"

#include "microros/xrce_client.h"
#include "microros/xrce_sinks.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* Start of the first fragment: the submessage's header, request id and object id. */
enum { FRAGMENTS_LENGTH_AT = 2, FRAGMENTS_REQUEST_AT = 4, FRAGMENTS_OBJECT_AT = 6, BEGIN_SIZE = 8 };

void xrce_fragments_reset(xrce_fragments_t * fragments)
{
  fragments->begun = false;
  fragments->skipping = false;
}

/* Returns whether the sample that starts like this has room; otherwise its reader is informed. */
static bool fragments_begin(xrce_client_t * client, const uint8_t * begin, size_t size)
{
  xrce_fragments_t * fragments = &client->fragments;
  uint16_t length;

  if (size < BEGIN_SIZE || begin[0] != XRCE_DATA || (begin[1] & XRCE_READ_FORMATS) != 0u) {
    ++client->session.statistics.malformed;
    return false;
  }
  fragments->sample.request = xrce_get_be16(&begin[FRAGMENTS_REQUEST_AT]);
  fragments->sample.object = xrce_get_be16(&begin[FRAGMENTS_OBJECT_AT]);
  fragments->sample.flags = begin[1];
  if (xrce_sinks_begin(client, &fragments->sample)) { /* of any length: the last fragment ends it */
    fragments->begun = true;
    return true;
  }
  length = xrce_get_le16(&begin[FRAGMENTS_LENGTH_AT]);
  if (length <= XRCE_OBJECT_PREFIX) {
    ++client->session.statistics.malformed;
    return false;
  }
  fragments->sample.size = (uint16_t)(length - XRCE_OBJECT_PREFIX);
  fragments->arrived = 0;
  fragments->begun = true;
  return xrce_read_begin(client, &fragments->sample);
}

/* Appends a fragment to the sample; false if it does not belong to it, or if the slot was reused. */
static bool fragments_add(xrce_client_t * client, const uint8_t * fragment, size_t size)
{
  xrce_fragments_t * fragments = &client->fragments;
  uint8_t * place;

  if (xrce_sinks_add(client, &fragments->sample, fragment, size)) {
    return true;
  }
  place = xrce_read_place(client, &fragments->sample);
  if (place == NULL) {
    return false;
  }
  if (size > (size_t)fragments->sample.size - fragments->arrived) {
    ++client->session.statistics.malformed;
    return false;
  }
  (void)memcpy(&place[fragments->arrived], fragment, size); /* at most MICROROS_INPUT_SIZE bytes */
  fragments->arrived = (uint16_t)(fragments->arrived + size);
  return true;
}

static bool fragments_take(xrce_client_t * client, const uint8_t * payload, size_t size)
{
  if (client->fragments.begun) {
    return fragments_add(client, payload, size);
  }
  return fragments_begin(client, payload, size) &&
         fragments_add(client, &payload[BEGIN_SIZE], size - BEGIN_SIZE);
}

static void fragments_finish(xrce_client_t * client, uint32_t now)
{
  const xrce_fragments_t * fragments = &client->fragments;

  if (fragments->arrived == fragments->sample.size) {
    xrce_read_finish(client, &fragments->sample, now);
  } else {
    ++client->session.statistics.malformed;
  }
}

void xrce_fragments_on_fragment(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  xrce_fragments_t * fragments = &client->fragments;
  const uint16_t number = (uint16_t)(client->reliable_input.next - 1u);

  if ((fragments->begun || fragments->skipping) && number != fragments->next) {
    fragments->skipping = true; /* a fragment is no longer available */
  }
  fragments->next = (uint16_t)(number + 1u);
  if (!fragments->skipping) {
    fragments->skipping = !fragments_take(client, xrce_payload_of(submessage), size);
  }
  if ((xrce_flags_of(submessage) & XRCE_FLAG_LAST_FRAGMENT) != 0u) {
    if (!xrce_sinks_end(client, &fragments->sample, !fragments->skipping) && !fragments->skipping) {
      fragments_finish(client, now);
    }
    xrce_fragments_reset(fragments);
  }
}
