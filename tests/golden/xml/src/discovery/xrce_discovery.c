/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_discovery.h"

#include "microros/xrce_client.h"
#include "microros/xrce_input.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* Times of discovery: to open a session at a locator, to collect answers to a request, between two looks
 * for answers; and the number of answers processed in one look. */
enum {
  TRY_MS = 3 * MICROROS_RETRY_FIRST_MS,
  REPLIES_MS = 2 * MICROROS_RETRY_FIRST_MS,
  LOOK_MS = 20,
  REPLIES_PER_POLL = 8
};

/* Part of an answer that is read: the first three locators. */
enum { ANSWER_SIZE = 60 };

static char * discovery_put_number(char * at, uint8_t number)
{
  if (number >= 100u) {
    *at++ = (char)('0' + (char)(number / 100u));
  }
  if (number >= 10u) {
    *at++ = (char)('0' + (char)(number / 10u % 10u));
  }
  *at++ = (char)('0' + (char)(number % 10u));
  return at;
}

uint16_t xrce_discovery_take(xrce_discovery_t * discovery)
{
  const xrce_place_t * place = &discovery->places[discovery->next];
  char * at = discovery->host;

  for (size_t i = 0; i < PORT_MULTICAST_ADDRESS; ++i) {
    if (i != 0u) {
      *at++ = '.';
    }
    at = discovery_put_number(at, place->address[i]);
  }
  *at = '\0';
  ++discovery->next;
  return place->port;
}

void xrce_discovery_end(xrce_discovery_t * discovery)
{
  if (discovery->open) {
    port_multicast_close(&discovery->group);
    discovery->open = false;
  }
  discovery->searching = false;
  discovery->count = 0;
  discovery->next = 0;
}

static void discovery_request(xrce_discovery_t * discovery, uint32_t now)
{
  if (!discovery->searching) {
    discovery->searching = true;
    discovery->since_ms = now;
  } else if (!xrce_is_due(now, discovery->due_ms)) {
    return;
  }
  discovery->open = discovery->open || port_multicast_open(&discovery->group);
  if (discovery->open) {
    uint8_t request[XRCE_DISCOVERY_REQUEST];

    xrce_discovery_write_request(request);
    (void)port_multicast_send(
      &discovery->group, XRCE_DISCOVERY_GROUP, MICROROS_DISCOVERY_PORT, request, sizeof(request));
  }
  discovery->requested_ms = now;
  discovery->due_ms = now + xrce_session_pause(now - discovery->since_ms);
}

bool xrce_discovery_search(xrce_discovery_t * discovery, uint32_t now)
{
  uint8_t * answer = xrce_input; /* the input buffer is unused without a session */
  uint8_t sender[PORT_MULTICAST_ADDRESS];

  if (discovery->next == discovery->count) {
    discovery->next = 0;
    discovery->count = 0;
    discovery_request(discovery, now);
  }
  for (uint8_t i = 0; i < REPLIES_PER_POLL && discovery->open; ++i) {
    const size_t size = port_multicast_receive(&discovery->group, answer, ANSWER_SIZE, sender);

    if (size == 0u) {
      break;
    }
    xrce_discovery_on_info(discovery, answer, size, sender);
  }
  return discovery->next != discovery->count;
}

/* Lets the session connect to the next locator. */
static void discovery_try(xrce_client_t * client, uint32_t now)
{
  xrce_discovery_t * discovery = &client->discovery;
  xrce_transport_t * transport = &client->session.transport;

  xrce_session_mark_lost(client, now); /* connects again */
  transport->port = xrce_discovery_take(discovery);
  transport->host = discovery->host;
  discovery->trying = true;
  discovery->due_ms = now + TRY_MS;
}

bool xrce_discovery_step(xrce_client_t * client, uint32_t now)
{
  xrce_discovery_t * discovery = &client->discovery;
  xrce_session_t * session = &client->session;

  if (!discovery->wanted) {
    discovery->wanted = strcmp(xrce_transport_name(&session->transport), XRCE_DISCOVERY_GROUP) == 0;
  }
  if (!discovery->wanted) {
    return true;
  }
  if (session->state != XRCE_CONNECTING) {
    xrce_discovery_end(discovery);
    discovery->due_ms = now + TRY_MS; /* grace period of the known address after a loss */
    return true;
  }
  if (discovery->trying && !xrce_is_due(now, discovery->due_ms)) {
    return true;
  }
  if (discovery->trying) {
    discovery->trying = false;
    discovery->due_ms = now;
  }
  if (xrce_discovery_search(discovery, now)) {
    discovery_try(client, now);
    return true;
  }
  session->due_ms = now - discovery->requested_ms < (uint32_t)REPLIES_MS ? now + LOOK_MS : discovery->due_ms;
  return false;
}
