/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_ping.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

enum { INFO_SIZE = 6, IMPLEMENTATION_OUT_OF_SESSION = 0 };

void xrce_ping_reset(xrce_ping_t * ping)
{
  ping->unanswered = 0;
}

void xrce_ping_write(uint8_t * message, uint8_t session)
{
  xrce_put_get_info(message, session);
}

void xrce_ping_step(xrce_client_t * client, uint32_t now)
{
  uint8_t message[XRCE_PING_SIZE];
  xrce_ping_t * ping = &client->ping;

  if (client->session.state != XRCE_READY) {
    return;
  }
  if (now - client->session.heard_ms < MICROROS_LIVELINESS_PERIOD_MS) {
    ping->unanswered = 0;
    ping->due_ms = now;
    return;
  }
  if (!xrce_is_due(now, ping->due_ms)) {
    return;
  }
  if (ping->unanswered == MICROROS_LIVELINESS_ATTEMPTS) {
    xrce_session_lose(client, now);
    return;
  }
  xrce_ping_write(message, XRCE_SESSION_ID);
  (void)xrce_session_send(&client->session, message, sizeof(message)); /* a loss counts as no answer */
  ++ping->unanswered;
  ping->due_ms = now + MICROROS_LIVELINESS_PERIOD_MS;
}

void xrce_ping_on_info(
  xrce_client_t * client, const uint8_t * payload, size_t size, bool in_session, uint32_t now)
{
  if (size < INFO_SIZE) {
    ++client->session.statistics.malformed;
    return;
  }
  client->ping.answered = true;
  if (in_session && payload[5] == IMPLEMENTATION_OUT_OF_SESSION && client->session.state == XRCE_READY) {
    xrce_session_lose(client, now);
  }
}
