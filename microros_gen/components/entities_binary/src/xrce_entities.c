/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_entities.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_entities_binary.h"
#include "microros/xrce_wire.h"

enum { PLACES = MICROROS_NODES_MAX + MICROROS_PUBLISHERS_MAX, NO_PLACE = 0xffff, STATUS_SIZE = 6 };

/* What has to be done at a place. */
typedef enum job_t { JOB_NONE, JOB_CREATE, JOB_DELETE } job_t;

static const uint8_t writer_kinds[] = {XRCE_KIND_TOPIC, XRCE_KIND_PUBLISHER, XRCE_KIND_DATAWRITER};

const xrce_writer_t * xrce_entities_writer(const xrce_client_t * client, uint16_t place)
{
  return &client->writers[place - MICROROS_NODES_MAX];
}

static xrce_object_state_t * entities_state(xrce_client_t * client, uint16_t place)
{
  return place < MICROROS_NODES_MAX ? &client->participants[place].state
                                    : &client->writers[place - MICROROS_NODES_MAX].state;
}

/* Returns how many objects a complete place has at the agent. */
static uint8_t entities_full_level(uint16_t place)
{
  return place < MICROROS_NODES_MAX ? (uint8_t)XRCE_PARTICIPANT_COMPLETE : (uint8_t)XRCE_WRITER_COMPLETE;
}

/* Returns the kind of a place's object; `level` counts from 0. */
static uint8_t entities_kind(uint16_t place, uint8_t level)
{
  return place < MICROROS_NODES_MAX ? (uint8_t)XRCE_KIND_PARTICIPANT : writer_kinds[level];
}

static uint16_t entities_object(uint16_t place, uint8_t kind)
{
  return xrce_object_id(place < MICROROS_NODES_MAX ? place : (uint16_t)(place - MICROROS_NODES_MAX), kind);
}

static bool entities_has_writers(const xrce_client_t * client, uint16_t participant)
{
  for (uint16_t i = 0; i < MICROROS_PUBLISHERS_MAX; ++i) {
    if (client->writers[i].participant == participant && client->writers[i].state.level != 0u) {
      return true;
    }
  }
  return false;
}

static job_t entities_job(xrce_client_t * client, uint16_t place)
{
  const xrce_object_state_t * state = entities_state(client, place);
  const bool is_participant = place < MICROROS_NODES_MAX;

  if (!state->wanted || state->stale) {
    if (state->level == 0u || (is_participant && entities_has_writers(client, place))) {
      return JOB_NONE;
    }
    return JOB_DELETE;
  }
  if (state->level == entities_full_level(place)) {
    return JOB_NONE;
  }
  if (!is_participant) {
    const xrce_object_state_t * parent = &client->participants[xrce_entities_writer(client, place)->participant].state;

    if (parent->level == 0u || parent->stale) {
      return JOB_NONE;
    }
  }
  return JOB_CREATE;
}

void xrce_entities_reset(xrce_client_t * client)
{
  xrce_entities_t * entities = &client->entities;

  for (uint16_t place = 0; place < PLACES; ++place) {
    xrce_object_state_t * state = entities_state(client, place);

    state->wanted = false;
    state->stale = false;
    state->level = 0;
  }
  entities->cursor = 0;
  entities->outstanding = false;
  entities->pending = false;
  entities->refused_place = NO_PLACE;
}

/* Lets the next step look for work at once. */
static void entities_wake(xrce_client_t * client, uint32_t now)
{
  client->entities.pending = true;
  if (!client->entities.outstanding) {
    client->entities.due_ms = now;
  }
}

void xrce_entities_renew(xrce_client_t * client, uint32_t now)
{
  for (uint16_t place = 0; place < PLACES; ++place) {
    xrce_object_state_t * state = entities_state(client, place);

    if (state->wanted && !state->stale) {
      state->level = 0;
    }
  }
  client->entities.outstanding = false;
  entities_wake(client, now);
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
  entities->refused_level = entities_state(client, entities->cursor)->level;
  entities->outstanding = false;
  entities->due_ms = now + MICROROS_RETRY_FIRST_MS;
  entities->cursor = (uint16_t)(entities->cursor + 1u < PLACES ? entities->cursor + 1u : 0u); /* others first */
}

static void entities_send(xrce_client_t * client, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;
  const uint16_t place = entities->cursor;
  const uint8_t level = entities_state(client, place)->level;
  const uint8_t kind = entities_kind(place, entities->deleting ? (uint8_t)(level - 1u) : level);
  const uint32_t doubled = 2u * (uint32_t)entities->retry_ms;

  entities->due_ms = now + entities->retry_ms;
  entities->retry_ms = (uint16_t)(doubled < MICROROS_RETRY_MOST_MS ? doubled : MICROROS_RETRY_MOST_MS);
  if (entities->deleting) {
    xrce_entities_send_delete(client, entities_object(place, kind));
  } else if (!xrce_entities_send_create(client, place, entities_object(place, kind), kind)) {
    entities_refuse(client, XRCE_STATUS_RESOURCES, now);
  }
}

/* Begins the next request; false: there is nothing to do. */
static bool entities_begin(xrce_client_t * client, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;

  for (uint16_t i = 0; i < PLACES; ++i) {
    const job_t job = entities_job(client, entities->cursor);

    if (job != JOB_NONE) {
      entities->deleting = job == JOB_DELETE;
      entities->outstanding = true;
      entities->request = xrce_session_next_request(&client->session);
      entities->retry_ms = MICROROS_RETRY_FIRST_MS;
      entities_send(client, now);
      return true;
    }
    entities->cursor = (uint16_t)(entities->cursor + 1u < PLACES ? entities->cursor + 1u : 0u);
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

/* The agent has done what was asked. A deletion is done whatever it says: an unknown object is what we wanted. */
static void entities_advance(xrce_client_t * client, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;
  xrce_object_state_t * state = entities_state(client, entities->cursor);

  state->level = (uint8_t)(entities->deleting ? state->level - 1u : state->level + 1u);
  if (state->level == 0u) {
    state->stale = false;
  }
  entities->outstanding = false;
  entities->due_ms = now;
}

void xrce_entities_on_status(xrce_client_t * client, const uint8_t * payload, size_t size, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;

  if (size < STATUS_SIZE) {
    ++client->session.statistics.malformed;
    return;
  }
  if (!entities->outstanding || xrce_get_be16(&payload[0]) != entities->request) {
    return; /* the answer to a repetition, or to a request of another part */
  }
  if (entities->deleting || payload[4] <= XRCE_STATUS_OK_MATCHED) {
    entities_advance(client, now);
  } else {
    entities_refuse(client, payload[4], now);
  }
}

void xrce_entities_add(xrce_client_t * client, xrce_object_state_t * state)
{
  state->stale = state->level != 0u;
  state->wanted = true;
  entities_wake(client, port_time_ms());
}

void xrce_entities_remove(xrce_client_t * client, xrce_object_state_t * state)
{
  state->wanted = false;
  entities_wake(client, port_time_ms());
}

void xrce_entities_remove_participant(xrce_client_t * client, uint16_t index)
{
  for (uint16_t i = 0; i < MICROROS_PUBLISHERS_MAX; ++i) {
    if (client->writers[i].participant == index) {
      client->writers[i].state.wanted = false;
    }
  }
  xrce_entities_remove(client, &client->participants[index].state);
}

static bool entities_is_done(xrce_client_t * client, uint16_t place)
{
  const xrce_object_state_t * state = entities_state(client, place);

  return state->wanted ? !state->stale && state->level == entities_full_level(place) : state->level == 0u;
}

static xrce_outcome_t entities_await(xrce_client_t * client, uint16_t place, uint32_t timeout_ms)
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

xrce_outcome_t xrce_entities_await_participant(xrce_client_t * client, uint16_t index, uint32_t timeout_ms)
{
  return entities_await(client, index, timeout_ms);
}

xrce_outcome_t xrce_entities_await_writer(xrce_client_t * client, uint16_t index, uint32_t timeout_ms)
{
  return entities_await(client, (uint16_t)(MICROROS_NODES_MAX + index), timeout_ms);
}
