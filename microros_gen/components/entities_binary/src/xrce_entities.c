/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_entities.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_entities_binary.h"
#include "microros/xrce_wire.h"

enum { NO_PLACE = 0xffff, STATUS_SIZE = 6 };

static bool entities_is_participant(uint16_t place)
{
  return place < MICROROS_NODES_MAX;
}

/* Returns how many objects the place should have at the agent. */
static uint8_t entities_goal(const xrce_client_t * client, uint16_t place)
{
  const xrce_object_state_t * state = &client->states[place];

  if (!state->wanted || state->stale) {
    return 0;
  }
  return entities_is_participant(place) ? (uint8_t)XRCE_PARTICIPANT_COMPLETE : (uint8_t)XRCE_WRITER_COMPLETE;
}

/* Whether a place can move on: a writer needs its participant, a participant outlives its writers. */
static bool entities_is_free(const xrce_client_t * client, uint16_t place, uint8_t goal)
{
  if (!entities_is_participant(place)) {
    const xrce_object_state_t * parent = &client->states[xrce_entities_writer(client, place)->participant];

    return goal == 0u || (parent->level != 0u && !parent->stale);
  }
  if (goal == 0u) {
    for (uint16_t i = 0; i < MICROROS_PUBLISHERS_MAX; ++i) {
      if (client->writers[i].participant == place && client->states[MICROROS_NODES_MAX + i].level != 0u) {
        return false;
      }
    }
  }
  return true;
}

static void entities_next_place(xrce_entities_t * entities)
{
  const uint16_t next = (uint16_t)(entities->cursor + 1u);

  entities->cursor = next < XRCE_PLACES ? next : 0u;
}

/* Lets the next step look for work at once. */
static void entities_wake(xrce_entities_t * entities, uint32_t now)
{
  entities->pending = true;
  if (!entities->outstanding) {
    entities->due_ms = now;
  }
}

void xrce_entities_renew(xrce_client_t * client, uint32_t now)
{
  for (size_t place = 0; place < XRCE_PLACES; ++place) {
    xrce_object_state_t * state = &client->states[place];

    if (state->wanted && !state->stale) {
      state->level = 0;
    }
  }
  client->entities.outstanding = false;
  entities_wake(&client->entities, now);
}

bool xrce_entities_settled(const xrce_client_t * client)
{
  return !client->entities.pending;
}

static void entities_refuse(xrce_client_t * client, uint8_t status, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;

  ++client->session.statistics.refused;
  entities->refused_place = entities->cursor;
  entities->refused_status = status;
  entities->outstanding = false;
  entities->due_ms = now + MICROROS_RETRY_FIRST_MS;
  entities_next_place(entities); /* others first */
}

static void entities_send(xrce_client_t * client, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;
  const uint8_t level = client->states[entities->cursor].level;

  /* There is a session: what does not come was a lost datagram, and a caller waits. So the pause does not grow. */
  entities->due_ms = now + MICROROS_RETRY_FIRST_MS;
  if (entities->deleting) {
    xrce_entities_send_delete(client, entities->cursor, (uint8_t)(level - 1u));
  } else {
    xrce_entities_send_create(client, entities->cursor, level);
  }
}

/* Begins the next request; false: there is nothing to do. */
static bool entities_begin(xrce_client_t * client, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;

  for (size_t i = 0; i < XRCE_PLACES; ++i) {
    const uint8_t level = client->states[entities->cursor].level;
    const uint8_t goal = entities_goal(client, entities->cursor);

    if (level != goal && entities_is_free(client, entities->cursor, goal)) {
      entities->deleting = level > goal;
      entities->outstanding = true;
      entities->request = xrce_session_next_request(&client->session);
      entities_send(client, now);
      return true;
    }
    entities_next_place(entities);
  }
  return false;
}

void xrce_entities_step(xrce_client_t * client, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;

  if (!entities->pending || client->session.state != XRCE_READY || !xrce_is_due(now, entities->due_ms)) {
    return;
  }
  if (entities->outstanding) {
    entities_send(client, now);
  } else {
    entities->pending = entities_begin(client, now);
  }
}

void xrce_entities_on_status(xrce_client_t * client, const uint8_t * payload, size_t size, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;
  xrce_object_state_t * state = &client->states[entities->cursor];

  if (size < STATUS_SIZE) {
    ++client->session.statistics.malformed;
    return;
  }
  if (!entities->outstanding || xrce_get_be16(&payload[0]) != entities->request) {
    return; /* the answer to a repetition, or to a request of another part */
  }
  if (entities->deleting) {
    --state->level; /* whatever the agent says: an unknown object is what we wanted */
    state->stale = state->stale && state->level != 0u;
  } else if (payload[4] <= XRCE_STATUS_OK_MATCHED) {
    ++state->level;
  } else {
    entities_refuse(client, payload[4], now);
    return;
  }
  entities->outstanding = false;
  entities->due_ms = now;
}

void xrce_entities_add(xrce_client_t * client, uint16_t place)
{
  xrce_object_state_t * state = &client->states[place];

  state->stale = state->level != 0u;
  state->wanted = true;
  entities_wake(&client->entities, client->session.now_ms);
}

void xrce_entities_remove(xrce_client_t * client, uint16_t place)
{
  client->states[place].wanted = false;
  for (uint16_t i = 0; i < MICROROS_PUBLISHERS_MAX; ++i) {
    if (client->writers[i].participant == place) {
      client->states[MICROROS_NODES_MAX + i].wanted = false;
    }
  }
  entities_wake(&client->entities, client->session.now_ms);
}

static bool entities_is_done(const xrce_client_t * client, uint16_t place)
{
  const xrce_object_state_t * state = &client->states[place];

  return !state->stale && state->level == entities_goal(client, place);
}

xrce_outcome_t xrce_entities_await(xrce_client_t * client, uint16_t place, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();

  client->entities.refused_place = NO_PLACE;
  for (;;) {
    xrce_session_pump(client);
    if (entities_is_done(client, place)) {
      return XRCE_DONE;
    }
    if (client->entities.refused_place == place) {
      return XRCE_REFUSED;
    }
    if (port_time_ms() - start >= timeout_ms) {
      return XRCE_SILENT;
    }
    port_sleep_ms(1);
  }
}
