/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_peer.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_peer_calling.h"
#include "microros/xrce_peer_find.h"
#include "microros/xrce_peer_find_note.h"
#include "microros/xrce_peer_serving.h"
#include "microros/xrce_peer_settle.h"
#include "microros/xrce_turn_bytes.h"
#include "microros/xrce_whole.h"
#include "microros/xrce_wire.h"

#include <string.h>

xrce_peer_port_t xrce_peer_ports[MICROROS_PEERS];

/* A line keeps a partial message in it. */
static uint8_t peer_input[MICROROS_PEERS][MICROROS_PEER_HEAD + MICROROS_PEER_MTU];

/* Positions in CREATE_CLIENT and STATUS_AGENT (OMG DDS-XRCE 1.0, 8.3.5.1 and 8.3.5.5). */
enum {
  CREATE_COOKIE_AT = 8,
  CREATE_KEY_AT = 16,
  CREATE_SESSION_AT = 20,
  CREATE_PROPERTIES_AT = 21,
  CREATE_MTU_AT = 22,
  CREATE_SIZE = 24,
  STATUS_AT = 8,
  STATUS_COOKIE_AT = 10,
  STATUS_SIZE = 19,
  COOKIE_AND_MAJOR = 5
};

/* Limits the messages of a link per pump, so that a flood cannot block the client. */
enum { MESSAGES_PER_PUMP = 16 };

static const uint8_t peer_cookie_and_version[] = {'X', 'R', 'C', 'E', 1, 0, 1, 15};

uint8_t * xrce_peer_input(uint8_t index)
{
  return peer_input[index];
}

static uint32_t peer_next_key(uint32_t key)
{
  return (key & ~XRCE_PEER_NUMBER) | ((key + 1u) & XRCE_PEER_NUMBER);
}

static void peer_send_create(xrce_client_t * client, uint8_t index)
{
  const xrce_peer_t * peer = &client->peers[index];
  uint8_t message[CREATE_SIZE];

  xrce_put_header(message, XRCE_SESSION_NONE, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(
    &message[4], XRCE_CREATE_CLIENT, XRCE_FLAG_LITTLE_ENDIAN, CREATE_SIZE - CREATE_COOKIE_AT);
  (void)memcpy(&message[CREATE_COOKIE_AT], peer_cookie_and_version, sizeof(peer_cookie_and_version));
  xrce_put_be16(&message[CREATE_KEY_AT], (uint16_t)(peer->key >> 16));
  xrce_put_be16(&message[CREATE_KEY_AT + 2], (uint16_t)(peer->key & 0xffffu));
  message[CREATE_SESSION_AT] = xrce_peer_own(peer, &xrce_peer_lines[index]);
  message[CREATE_PROPERTIES_AT] = 0;
  xrce_put_le16(&message[CREATE_MTU_AT], xrce_peer_lines[index].mtu);
  (void)xrce_peer_send(client, index, message, sizeof(message)); /* a lost message is repeated */
}

static void peer_connect(xrce_client_t * client, uint8_t index, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];

  if (peer->ready || (peer->key != 0u && !xrce_is_due(now, peer->due_ms))) {
    return;
  }
  if (peer->key == 0u) {
    peer->key = xrce_peer_lines[index].key;
    peer->since_ms = now;
  }
  if (!xrce_peer_ports[index].is_open) {
    xrce_peer_ports[index].is_open = xrce_peer_open(&xrce_peer_ports[index].transport, index);
  }
  peer_send_create(client, index);
  peer->due_ms = now + xrce_session_pause(now - peer->since_ms);
}

/* Asks for a new session; answers to messages of this one are then too late. */
static void peer_reconnect(xrce_peer_t * peer, uint32_t now)
{
  peer->key = peer_next_key(peer->key);
  peer->ready = false;
  peer->since_ms = now;
  peer->due_ms = now;
}

/* Handles an answer to CREATE_CLIENT. */
static void peer_on_status(xrce_peer_t * peer, uint8_t index, uint8_t status, uint32_t now)
{
  if (peer->ready) {
    return; /* answer to a repetition */
  }
  if (status <= XRCE_STATUS_OK_MATCHED) {
    peer->ready = true;
    xrce_peer_renumber(peer, index, now);
  } else if (status == XRCE_STATUS_ALREADY_EXISTS) {
    peer->key = peer_next_key(peer->key);
    peer->due_ms = now;
  } else {
    peer->due_ms =
      now + MICROROS_RETRY_MOST_MS; /* the other board has another table: it may get a new image */
  }
}

/* Handles a message in the own session. */
static void peer_take_answer(xrce_client_t * client, uint8_t index, const uint8_t * message, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];
  const uint8_t * submessage = &message[XRCE_MESSAGE_HEADER];
  const size_t size = xrce_get_le16(&submessage[2]);

  if (submessage[0] == XRCE_STATUS_AGENT && size >= 2u) {
    peer_on_status(peer, index, xrce_payload_of(submessage)[0], now);
  } else if (submessage[0] == XRCE_ACKNACK) {
    xrce_peer_acknowledged(peer, index, xrce_payload_of(submessage), size, xrce_flags_of(submessage), now);
  } else if (submessage[0] == XRCE_RESET && peer->ready) {
    peer_reconnect(peer, now);
    xrce_peer_calling_renew(client, index);
  } else {
    ++client->session.statistics.malformed;
  }
}

/* Answers CREATE_CLIENT with this key. */
static void peer_send_status(xrce_client_t * client, uint8_t index, uint32_t key, uint8_t status)
{
  const uint8_t position = (uint8_t)(1u - xrce_peer_lines[index].position);
  uint8_t message[STATUS_SIZE];

  xrce_put_header(message, xrce_peer_session(key, position), XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_STATUS_AGENT, XRCE_FLAG_LITTLE_ENDIAN, STATUS_SIZE - STATUS_AT);
  message[STATUS_AT] = status;
  message[STATUS_AT + 1] = 0;
  (void)memcpy(&message[STATUS_COOKIE_AT], peer_cookie_and_version, sizeof(peer_cookie_and_version));
  message[STATUS_SIZE - 1] = 0;                                  /* no properties */
  (void)xrce_peer_send(client, index, message, sizeof(message)); /* the other board asks again */
}

/* Returns whether a key is that of an earlier session, or of a session in which something has arrived. */
static bool peer_is_used(const xrce_peer_t * peer, uint32_t key)
{
  return key == peer->former_key || (key == peer->other_key && peer->received);
}

/* Handles CREATE_CLIENT. */
static void peer_take_client(
  xrce_client_t * client, uint8_t index, const uint8_t * message, size_t size, uint32_t now)
{
  xrce_peer_t * peer = &client->peers[index];
  const xrce_peer_line_t * line = &xrce_peer_lines[index];
  uint32_t key;

  if (
    size < CREATE_SIZE || message[XRCE_MESSAGE_HEADER] != XRCE_CREATE_CLIENT ||
    memcmp(&message[CREATE_COOKIE_AT], peer_cookie_and_version, COOKIE_AND_MAJOR) != 0) {
    ++client->session.statistics.malformed;
    return;
  }
  key = ((uint32_t)xrce_get_be16(&message[CREATE_KEY_AT]) << 16) | xrce_get_be16(&message[CREATE_KEY_AT + 2]);
  if (message[CREATE_SESSION_AT] != xrce_peer_session(key, (uint8_t)(1u - line->position))) {
    ++client->session.statistics.malformed; /* also its own message, from a line that is not connected well */
    return;
  }
  if ((key & ~XRCE_PEER_NUMBER) != (line->key & ~XRCE_PEER_NUMBER)) {
    ++client->session.statistics.refused;
    peer_send_status(client, index, key, XRCE_STATUS_INCOMPATIBLE);
    return;
  }
  if (peer_is_used(peer, key)) {
    peer_send_status(client, index, key, XRCE_STATUS_ALREADY_EXISTS);
    return;
  }
  if (key != peer->other_key) {
    peer->former_key = peer->other_key;
    peer->other_key = key;
    xrce_peer_serving_begin(index);
    if (peer->ready) {
      xrce_peer_heartbeat(client, index); /* has it restarted, and forgotten the own session? */
    }
  }
  xrce_peer_hurry(peer, now);
  xrce_peer_in_reset(peer, index);
  peer_send_status(client, index, key, XRCE_STATUS_OK);
}

bool xrce_peer_is_whole(const uint8_t * message, size_t size)
{
  return xrce_is_whole(message, size);
}

static void peer_take(
  xrce_client_t * client, uint8_t index, const uint8_t * message, size_t size, uint32_t now)
{
  const xrce_peer_line_t * line = &xrce_peer_lines[index];

  if (!xrce_peer_is_whole(message, size)) {
    ++client->session.statistics.malformed;
  } else if (message[0] == XRCE_SESSION_NONE) {
    peer_take_client(client, index, message, size, now);
  } else if (!xrce_peer_is_own(message[0], line)) {
    xrce_peer_in_take(client, index, message, size, now);
  } else if (message[0] == xrce_peer_own(&client->peers[index], line)) {
    peer_take_answer(client, index, message, now);
  } else {
    ++client->session.statistics.dropped; /* an answer in an earlier session */
  }
}

static void peer_receive(xrce_client_t * client, uint8_t index, uint32_t now)
{
  uint8_t * message = &peer_input[index][MICROROS_PEER_HEAD];
  xrce_peer_t * peer = &client->peers[index];
  xrce_peer_port_t * port = &xrce_peer_ports[index];

  peer->more = port->is_open;
  /* at most MESSAGES_PER_PUMP rounds */
  for (uint8_t i = 0; i < MESSAGES_PER_PUMP && port->is_open; ++i) {
    const int32_t size = xrce_transport_receive(&port->transport, message, MICROROS_PEER_MTU);

    if (size == 0) {
      peer->more = false;
      return;
    }
    /* cppcheck-suppress knownConditionTrueFalse ; without a task for the session nothing is partial */
    if (xrce_turn_is_partial(size)) {
      continue;
    }
    ++client->session.statistics.received;
    if (size < 0) {
      ++client->session.statistics.malformed;
    } else {
      peer_take(client, index, message, (size_t)size, now);
      xrce_peer_settle(client);
    }
  }
}

/* Counts a line whose device has returned. */
static void peer_look_at_line(xrce_client_t * client, uint8_t index, uint32_t now)
{
  const bool lost = xrce_peer_find(client, index, now);

  if (client->peers[index].lost && !lost) {
    ++client->session.statistics.reconnects;
    xrce_peer_hurry(&client->peers[index], now);
  }
  client->peers[index].lost = lost;
}

static void peer_step(xrce_client_t * client, uint32_t now)
{
  /* cppcheck-suppress knownConditionTrueFalse ; a constant of the plan */
  if (!xrce_peer_looks_for_agent()) {
    client->session.due_ms = now + MICROROS_RETRY_MOST_MS; /* so that it wakes nobody */
  }
  for (uint8_t i = 0; i < MICROROS_PEERS; ++i) {
    xrce_transport_begin_turn(&xrce_peer_ports[i].transport);
    peer_receive(client, i, now);
    peer_look_at_line(client, i, now);
    peer_connect(client, i, now);
    xrce_peer_flow(client, i, now);
  }
}

void xrce_peer_step(xrce_client_t * client, uint32_t now)
{
  if (client->session.state != (uint8_t)XRCE_CLOSED) {
    peer_step(client, now);
  }
}

uint32_t xrce_peer_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  uint32_t soonest = left;

  for (uint8_t i = 0; i < MICROROS_PEERS; ++i) {
    const xrce_peer_t * peer = &client->peers[i];

    if (peer->key == 0u || peer->more) {
      soonest = xrce_sooner(soonest, now, now);
    } else if (peer->lost) {
      /* the wait ends to look for the device */
    } else if (peer->ready && peer->unsent != 0u) {
      soonest = xrce_sooner(soonest, now + 1u, now); /* the line has no room */
    } else if (!peer->ready || peer->count != 0u) {
      soonest = xrce_sooner(soonest, peer->due_ms, now);
    } else {
      /* what arrives ends the wait */
    }
    soonest = xrce_peer_find_left(i, soonest, now);
  }
  return soonest;
}

void xrce_peer_wake(xrce_client_t * client)
{
  (void)memset(client->peers, 0, sizeof(client->peers));
  for (uint8_t i = 0; i < MICROROS_PEERS; ++i) {
    xrce_peer_calling_renew(client, i);
  }
}

/* Returns whether a link has sent everything, and all of it was acknowledged. */
static bool peer_is_done(const xrce_peer_t * peer, xrce_peer_port_t * port)
{
  return peer->count == 0u && (!peer->ready || xrce_transport_is_idle(&port->transport));
}

void xrce_peer_leave(xrce_client_t * client)
{
  const uint32_t start = port_time_ms();
  bool done = client->session.state == (uint8_t)XRCE_CLOSED; /* before a sleep */

  while (!done && port_time_ms() - start < client->close_timeout_ms) {
    peer_step(client, port_time_ms());
    done = true;
    for (uint8_t i = 0; i < MICROROS_PEERS; ++i) {
      done = done && peer_is_done(&client->peers[i], &xrce_peer_ports[i]);
    }
    if (!done) {
      microros_pause();
    }
  }
}

void xrce_peer_close(void)
{
  for (uint8_t i = 0; i < MICROROS_PEERS; ++i) {
    if (xrce_peer_ports[i].is_open) {
      xrce_transport_close(&xrce_peer_ports[i].transport);
      xrce_peer_ports[i].is_open = false;
    }
  }
}
