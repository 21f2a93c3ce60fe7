/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_ping.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

enum { INFO_SIZE = 6, IMPLEMENTATION_OUT_OF_SESSION = 0 };

void xrce_ping_reset(xrce_ping_t * ping)
{
  ping->unanswered = 0;
  ++ping->replies;
}

void xrce_ping_request(xrce_client_t * client)
{
  uint8_t message[XRCE_GET_INFO_SIZE];
  xrce_session_t * session = &client->session;
  const bool ready = session->state == (uint8_t)XRCE_READY;

  if (!session->transport_open && session->state == (uint8_t)XRCE_CONNECTING) {
    session->due_ms = session->now_ms; /* the next pump opens it, and its CREATE_CLIENT asks */
  }
  xrce_put_get_info(message, ready ? (uint8_t)XRCE_SESSION_ID : (uint8_t)XRCE_SESSION_NONE);
  (void)xrce_session_send(session, message, sizeof(message)); /* a lost message just remains unanswered */
}

void xrce_ping_step(xrce_client_t * client, uint32_t now)
{
  xrce_ping_t * ping = &client->ping;

  if (client->session.state != XRCE_READY) {
    return;
  }
  if (now - client->session.received_ms < MICROROS_LIVELINESS_PERIOD_MS) {
    ping->unanswered = 0;
    ping->due_ms = now;
    return;
  }
  if (!xrce_is_due(now, ping->due_ms)) {
    return;
  }
  if (ping->unanswered == MICROROS_LIVELINESS_ATTEMPTS) {
    xrce_session_mark_lost(client, now);
    return;
  }
  xrce_ping_request(client);
  ++ping->unanswered;
  ping->due_ms = now + MICROROS_LIVELINESS_WAIT_MS;
}

/* An agent answered: reconnect at once. */
static void ping_expedite(xrce_session_t * session, uint32_t now)
{
  session->since_ms = now;
  if (!xrce_is_due(now + MICROROS_RETRY_FIRST_MS, session->due_ms)) {
    session->due_ms = now + MICROROS_RETRY_FIRST_MS;
  }
}

void xrce_ping_on_info(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  if (size < INFO_SIZE) {
    ++client->session.statistics.malformed;
    return;
  }
  ++client->ping.replies;
  if (client->session.state == XRCE_CONNECTING) {
    ping_expedite(&client->session, now);
  } else if (
    client->session.in_session && xrce_payload_of(submessage)[5] == IMPLEMENTATION_OUT_OF_SESSION &&
    client->session.state == XRCE_READY) {
    xrce_session_mark_lost(client, now);
  } else {
    /* request after silence, or by the application */
  }
}
