/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_agents.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

enum { FAREWELL_SIZE = 6 };

/* Tries the current agent until the next one is due. */
static void agents_begin_try(xrce_agents_t * agents, uint32_t now)
{
  uint32_t wait_ms = MICROROS_AGENT_TRY_MS;

  ++agents->tried;
  if (agents->tried == MICROROS_AGENTS) { /* the round is over */
    const uint32_t pause_ms = xrce_session_pause(now - agents->since_ms);

    wait_ms = pause_ms > wait_ms ? pause_ms : wait_ms;
  }
  agents->due_ms = now + wait_ms;
}

static void agents_try_next(xrce_client_t * client, uint32_t now)
{
  xrce_agents_t * agents = &client->agents;

  xrce_session_mark_lost(client, now); /* closes the transport and connects again */
  client->session.refusal = 0;
  if (agents->tried == MICROROS_AGENTS) {
    agents->tried = 0;
  }
  agents->index = agents->index + 1u < MICROROS_AGENTS ? (uint8_t)(agents->index + 1u) : 0u;
  xrce_agents_set(&client->session.transport, agents->index);
  agents_begin_try(agents, now);
}

static void agents_begin_round(xrce_agents_t * agents, uint32_t now)
{
  agents->state = XRCE_AGENTS_TRYING;
  agents->since_ms = now;
  agents->tried = 0;
}

/* Starts a search: with the agent that the session was opened for, after a loss with the next one. */
static void agents_begin_search(xrce_client_t * client, uint32_t now)
{
  xrce_agents_t * agents = &client->agents;

  agents_begin_round(agents, now);
  /* An agent that has just answered, but not within the session, has restarted: it is there. */
  if (agents->used != 0u && client->session.received_ms != now) {
    agents_try_next(client, now);
  } else {
    agents_begin_try(agents, now);
  }
}

void xrce_agents_on_status(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);

  if (
    client->session.state == (uint8_t)XRCE_READY && client->agents.state == (uint8_t)XRCE_AGENTS_SETTLED &&
    size >= FAREWELL_SIZE && xrce_get_be16(&payload[0]) == XRCE_REQUEST_LOGOUT &&
    xrce_get_be16(&payload[2]) == XRCE_OBJECT_CLIENT) {
    agents_begin_round(&client->agents, now);
    agents_try_next(client, now);
  }
}

/* Decides whether the address of a session that was just opened is one of the list. */
static void agents_look(xrce_client_t * client)
{
  const uint8_t index = xrce_agents_find(&client->session.transport);

  client->agents.state = XRCE_AGENTS_OTHER;
  if (index != MICROROS_AGENTS) {
    client->agents.state = XRCE_AGENTS_SETTLED;
    client->agents.index = index;
  }
}

/* A refusal is final for this round, but the last agent of the round is left only in due time. */
static bool agents_gives_up(const xrce_client_t * client, uint32_t now)
{
  const xrce_agents_t * agents = &client->agents;

  return xrce_is_due(now, agents->due_ms) ||
         (client->session.refusal != 0u && agents->tried != MICROROS_AGENTS);
}

bool xrce_agents_step(xrce_client_t * client, uint32_t now)
{
  xrce_agents_t * agents = &client->agents;

  if (agents->state == (uint8_t)XRCE_AGENTS_NEW) {
    agents_look(client);
  }
  if (client->session.state != (uint8_t)XRCE_CONNECTING || agents->state == (uint8_t)XRCE_AGENTS_OTHER) {
    return true;
  }
  if (agents->state == (uint8_t)XRCE_AGENTS_SETTLED) {
    agents_begin_search(client, now);
  } else if (agents_gives_up(client, now)) {
    agents_try_next(client, now);
  } else {
    /* the agent still has time */
  }
  return true;
}

void xrce_agents_limit(xrce_client_t * client)
{
  xrce_session_t * session = &client->session;

  if (
    session->state == (uint8_t)XRCE_CONNECTING && client->agents.state == (uint8_t)XRCE_AGENTS_TRYING &&
    xrce_is_due(session->due_ms, client->agents.due_ms)) {
    session->due_ms = client->agents.due_ms;
  }
}

void xrce_agents_connected(xrce_client_t * client)
{
  xrce_agents_t * agents = &client->agents;

  if (agents->state != (uint8_t)XRCE_AGENTS_TRYING) {
    return;
  }
  agents->state = XRCE_AGENTS_SETTLED;
  if (agents->used != 0u && agents->used != agents->index + 1u) {
    ++agents->changes;
  }
  agents->used = (uint8_t)(agents->index + 1u);
}
