/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_session.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_input.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_session_take.h"
#include "microros/xrce_wire.h"

#include <string.h>

uint8_t xrce_input[MICROROS_INPUT_BUFFER_SIZE];

/* Whether the client has properties (0: none), then their names and values: strings, each aligned to four
 * bytes of the message. */
static const uint8_t properties[] = {0};

enum { PROPERTIES_AT = 21, CREATE_CLIENT_SIZE = PROPERTIES_AT + sizeof(properties) + 2 };

static const uint8_t cookie_and_version[] = {'X', 'R', 'C', 'E', 1, 0, 1, 15};

void xrce_session_open(xrce_client_t * client, uint32_t key)
{
  xrce_session_t * session = &client->session;

  (void)memset(client, 0, sizeof(*client));
  session->key = key;
  session->request = XRCE_REQUEST_FIRST;
  session->due_ms = port_time_ms();
  session->since_ms = session->due_ms;
  session->state = XRCE_CONNECTING;
  client->create_timeout_ms = MICROROS_CREATE_TIMEOUT_MS;
  client->close_timeout_ms = MICROROS_CLOSE_TIMEOUT_MS;
}

uint16_t xrce_session_next_request(xrce_session_t * session)
{
  const uint16_t request = session->request;

  session->request = request == UINT16_MAX ? (uint16_t)XRCE_REQUEST_FIRST : (uint16_t)(request + 1u);
  return request;
}

bool xrce_session_send(xrce_session_t * session, const uint8_t * message, size_t size)
{
  if (
    /* cppcheck-suppress knownConditionTrueFalse ; without a task for the session each task has the turn */
    !xrce_turn_is_mine() || !session->transport_open ||
    !xrce_turn_send(&session->transport, message, size)) {
    return false;
  }
  ++session->statistics.sent;
  return true;
}

static void session_close_transport(xrce_session_t * session)
{
  if (session->transport_open) {
    session->statistics.dropped += xrce_turn_close();
    xrce_transport_close(&session->transport);
    session->transport_open = false;
  }
}

static void session_send_create_client(xrce_session_t * session)
{
  uint8_t message[CREATE_CLIENT_SIZE];

  xrce_put_header(message, XRCE_SESSION_NONE, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_CREATE_CLIENT, XRCE_FLAG_LITTLE_ENDIAN, CREATE_CLIENT_SIZE - 8);
  (void)memcpy(&message[8], cookie_and_version, sizeof(cookie_and_version));
  xrce_put_be16(&message[16], (uint16_t)(session->key >> 16));
  xrce_put_be16(&message[18], (uint16_t)(session->key & 0xffffu));
  message[20] = XRCE_SESSION_ID;
  (void)memcpy(&message[PROPERTIES_AT], properties, sizeof(properties));
  xrce_put_le16(&message[PROPERTIES_AT + sizeof(properties)], MICROROS_INPUT_SIZE);
  (void)xrce_session_send(session, message, sizeof(message)); /* a lost message is repeated */
}

uint32_t xrce_session_pause(uint32_t wanted_ms)
{
  if (wanted_ms < MICROROS_RETRY_FIRST_MS) {
    return MICROROS_RETRY_FIRST_MS;
  }
  return wanted_ms < MICROROS_RETRY_MOST_MS ? wanted_ms : MICROROS_RETRY_MOST_MS;
}

void xrce_session_step(xrce_client_t * client, uint32_t now)
{
  xrce_session_t * session = &client->session;

  if (session->state != XRCE_CONNECTING || !xrce_is_due(now, session->due_ms)) {
    return;
  }
  if (!session->transport_open) {
    session->transport_open = xrce_transport_open(&session->transport);
  }
  session_send_create_client(session);
  session->due_ms = now + xrce_session_pause(now - session->since_ms);
}

void xrce_session_mark_lost(xrce_client_t * client, uint32_t now)
{
  xrce_session_t * session = &client->session;

  session_close_transport(session); /* a new socket uses a new local address */
  session->state = XRCE_CONNECTING;
  session->since_ms = now;
  session->due_ms = now;
  xrce_turn_change(client); /* another task may wait for the old socket */
}

void xrce_session_on_status_agent(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_session_t * session = &client->session;

  if (size < 2u) {
    ++session->statistics.malformed;
    return;
  }
  if (session->state != XRCE_CONNECTING) {
    return; /* answer to a repetition */
  }
  if (payload[0] > XRCE_STATUS_OK_MATCHED) {
    session->refusal = payload[0];
    return;
  }
  session->refusal = 0;
  session->state = XRCE_READY;
  session->received_ms = now;
  if (session->was_ready) {
    ++session->statistics.reconnects;
  }
  session->was_ready = true;
  xrce_route_connected(client, now);
}

bool xrce_session_take_submessages(xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now)
{
  size_t at = XRCE_MESSAGE_HEADER;

  client->session.in_session = message[0] == XRCE_SESSION_ID;
  while (at < size) { /* at most MICROROS_INPUT_SIZE / 4 rounds */
    size_t length;

    if (size - at < XRCE_SUBMESSAGE_HEADER) {
      return false;
    }
    length = xrce_get_le16(&message[at + 2u]);
    if (length > size - at - XRCE_SUBMESSAGE_HEADER) {
      return false;
    }
    /* cppcheck-suppress knownConditionTrueFalse ; without a task for the session each one is taken */
    if (at == (size_t)XRCE_MESSAGE_HEADER || xrce_turn_takes(length)) {
      /* at most 1 + (MICROROS_INPUT_SIZE - 5) / XRCE_TURN_SHORTEST_PLACE calls */
      xrce_route_submessage(client, &message[at], length, now);
    } else {
      ++client->session.statistics.malformed;
    }
    at = (at + XRCE_SUBMESSAGE_HEADER + length + 3u) & ~(size_t)3u;
  }
  return true;
}

static void session_receive(xrce_client_t * client, uint32_t now)
{
  /* at most XRCE_TURN_MESSAGES rounds */
  for (uint8_t i = 0; i < (uint8_t)XRCE_TURN_MESSAGES && client->session.transport_open; ++i) {
    if (!xrce_session_take(client, now)) {
      return;
    }
  }
}

/* Returns whether the calling task receives and sends; otherwise asks the one that does. */
static bool session_has_turn(const xrce_client_t * client)
{
  /* cppcheck-suppress knownConditionTrueFalse ; without a task for the session each task has the turn */
  if (!xrce_turn_is_mine()) {
    xrce_turn_request(client);
    return false;
  }
  xrce_turn_change(client);
  return true;
}

void xrce_session_step_all(xrce_client_t * client)
{
  const uint32_t now = port_time_ms();

  client->session.now_ms = now;
  if (session_has_turn(client)) {
    xrce_transport_begin_turn(&client->session.transport);
    xrce_route_step(client, now);
  }
}

void xrce_session_pump(xrce_client_t * client)
{
  const uint32_t now = port_time_ms();

  client->session.now_ms = now;
  if (session_has_turn(client)) {
    xrce_transport_begin_turn(&client->session.transport);
    session_receive(client, now);
    xrce_route_step(client, now);
  }
}

bool xrce_session_await(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();

  for (;;) {
    xrce_session_pump(client);
    if (client->session.state == XRCE_READY) {
      return true;
    }
    if (client->session.refusal != 0u || port_time_ms() - start >= timeout_ms) {
      return false;
    }
    microros_pause();
  }
}

bool xrce_session_drain(xrce_client_t * client)
{
  const uint32_t start = port_time_ms();

  if (client->session.state != XRCE_READY) {
    return false;
  }
  client->session.state = XRCE_CLOSING; /* accept no further messages */
  for (;;) {
    xrce_session_pump(client);
    if (xrce_session_is_sent(&client->session)) {
      return true;
    }
    if (port_time_ms() - start >= client->close_timeout_ms) {
      return false;
    }
    microros_pause();
  }
}

void xrce_session_close(xrce_client_t * client)
{
  client->session.state = XRCE_CLOSED;
  xrce_turn_change(client); /* another task may wait for it */
  session_close_transport(&client->session);
  (void)memset(client->states, 0, sizeof(client->states)); /* invalidates open handles */
}
