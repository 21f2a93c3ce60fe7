/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_creation.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_creation_stream.h"
#include "microros/xrce_wire.h"

static const uint16_t no_place = 0xffffu;

enum { STATUS_SIZE = 6, MOST_REFUSALS = 16 };

/* A search of few places takes less than the code that saves it. */
static const bool NOTES_ONE = XRCE_PLACES > 4;

/* Submessage header, request id, object id; then kind, format, padding and length of the description. */
enum {
  REQUEST_AT = 4,
  OBJECT_AT = 6,
  KIND_AT = 8,
  FORMAT_AT = 9,
  PADDING_AT = 10,
  LENGTH_AT = 12,
  BLOB_AT = 16,
  DELETE_SIZE = 8
};

static const MICROROS_FLASH uint8_t writer_kinds[] = {
  XRCE_KIND_TOPIC, XRCE_KIND_PUBLISHER, XRCE_KIND_DATAWRITER};
static const MICROROS_FLASH uint8_t reader_kinds[] = {
  XRCE_KIND_TOPIC, XRCE_KIND_SUBSCRIBER, XRCE_KIND_DATAREADER};

/* Returns the kind of an endpoint's object that is created after `level` others. */
static uint8_t entities_kind(uint16_t place, uint8_t level)
{
  if (xrce_place_is_service(place)) {
    return place < XRCE_REQUESTERS_AT ? (uint8_t)XRCE_KIND_REPLIER : (uint8_t)XRCE_KIND_REQUESTER;
  }
  return xrce_place_is_reader(place) ? reader_kinds[level] : writer_kinds[level];
}

const xrce_endpoint_t * xrce_entities_endpoint(const xrce_client_t * client, uint16_t place)
{
  return &client->endpoints[place - MICROROS_NODES_MAX];
}

uint8_t * xrce_describe_text(uint8_t * at, const MICROROS_ANYWHERE char * text)
{
  while (*text != '\0') { /* at most MICROROS_CREATION_SIZE or MICROROS_MTU rounds */
    *at++ = (uint8_t)*text++;
  }
  return at;
}

/* Returns how many objects of the place should exist at the agent. */
static uint8_t entities_goal(const xrce_client_t * client, uint16_t place)
{
  const xrce_object_state_t * state = &client->states[place];

  if (!state->wanted || state->stale) {
    return 0;
  }
  return xrce_place_complete(place);
}

/*
 * Returns whether a place can proceed: an endpoint needs its participant, a participant outlives its
 * endpoints. */
static bool entities_is_free(const xrce_client_t * client, uint16_t place, uint8_t goal)
{
  if (!xrce_place_is_participant(place)) {
    const xrce_object_state_t * parent = &client->states[xrce_entities_endpoint(client, place)->participant];

    return goal == 0u || (parent->level != 0u && !parent->stale);
  }
  if (goal == 0u) {
    for (uint16_t i = 0; i < (uint16_t)XRCE_ENDPOINTS; ++i) {
      if (client->endpoints[i].participant == place && client->states[MICROROS_NODES_MAX + i].level != 0u) {
        return false;
      }
    }
  }
  return true;
}

static void entities_next_place(xrce_entities_t * entities)
{
  const uint32_t next = (uint32_t)entities->cursor + 1u;

  entities->cursor = (uint16_t)(next < (uint32_t)XRCE_PLACES ? next : 0u);
}

/* Makes the next step look for work at once. */
static void entities_wake(xrce_entities_t * entities)
{
  entities->pending = XRCE_PENDING_ANY;
  entities->refusals = 0;
  entities->resting = false;
}

void xrce_entities_renew(xrce_client_t * client)
{
  for (size_t place = 0; place < XRCE_PLACES; ++place) {
    xrce_object_state_t * state = &client->states[place];

    if (state->wanted && (!state->stale || state->level == 0u)) {
      state->level = 0;
      state->stale = false;
    }
  }
  client->entities.outstanding = false;
  entities_wake(&client->entities);
}

static void entities_refuse(xrce_client_t * client, uint8_t status, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;

  ++client->session.statistics.refused;
  if (!client->states[entities->cursor].stale) {
    entities->refused_place = entities->cursor;
    entities->refused_status = status;
  }
  /*
   * Other places first; then try again after growing pauses, since the cause (a mistake, missing memory)
   * may persist. */
  entities->due_ms = now + xrce_session_pause((uint32_t)MICROROS_RETRY_FIRST_MS << entities->refusals);
  if (entities->refusals < MOST_REFUSALS) {
    ++entities->refusals;
  }
  entities->resting = true;
  entities->pending = XRCE_PENDING_ANY;
  entities_next_place(entities);
}

/*
 * Writes what follows the description: the domain of a participant, at an even position; the parent's id
 * of other objects. */
static uint8_t * entities_put_owner(
  const xrce_client_t * client, uint16_t place, uint8_t kind, uint8_t * end, bool odd)
{
  uint16_t parent;

  if (kind == XRCE_KIND_PARTICIPANT) {
    *end = 0;
    end += odd ? 1 : 0;
    xrce_put_le16(end, client->participants[place].domain_id);
    return &end[2];
  }
  parent = xrce_object_id(xrce_entities_endpoint(client, place)->participant, XRCE_KIND_PARTICIPANT);
  if (kind == XRCE_KIND_DATAWRITER) {
    parent = xrce_object_id((uint16_t)(place - MICROROS_NODES_MAX), XRCE_KIND_PUBLISHER);
  } else if (xrce_place_is_reader(place) && kind == XRCE_KIND_DATAREADER) {
    parent = xrce_object_id((uint16_t)(place - MICROROS_NODES_MAX), XRCE_KIND_SUBSCRIBER);
  }
  xrce_put_be16(end, parent);
  return &end[2];
}

/* Writes the part of CREATE after the object id; returns its end. */
static uint8_t * entities_put_object(
  const xrce_client_t * client, uint16_t place, uint8_t kind, uint8_t * room)
{
  uint8_t * const blob = &room[BLOB_AT];
  uint8_t * end;
  uint16_t size;

  room[KIND_AT] = kind;
  xrce_put_le16(&room[PADDING_AT], 0);
  end = xrce_describe(client, place, kind, blob, &room[FORMAT_AT]);
  size = xrce_size_between(blob, end);
  xrce_put_le32(&room[LENGTH_AT], size);
  return entities_put_owner(client, place, kind, end, (size & 1u) != 0u);
}

/* Returns the kind of the outstanding request's object. */
static uint8_t entities_outstanding_kind(const xrce_client_t * client)
{
  const xrce_entities_t * entities = &client->entities;
  const uint8_t level = client->states[entities->cursor].level;

  if (xrce_place_is_participant(entities->cursor)) {
    return XRCE_KIND_PARTICIPANT;
  }
  return entities_kind(entities->cursor, (uint8_t)(level - (entities->deleting ? 1u : 0u)));
}

/* Returns the id of the outstanding request's object, which has this kind. */
static uint16_t entities_outstanding_id(const xrce_client_t * client, uint8_t kind)
{
  const uint16_t place = client->entities.cursor;
  const uint16_t index = xrce_place_is_participant(place) ? place : (uint16_t)(place - MICROROS_NODES_MAX);

  return xrce_object_id(index, kind);
}

/* Sends the outstanding request. */
static void entities_send(xrce_client_t * client, uint32_t now)
{
  enum { CREATE_FLAGS = XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_REUSE | XRCE_FLAG_REPLACE };
  xrce_entities_t * entities = &client->entities;
  const uint8_t kind = entities_outstanding_kind(client);
  uint8_t * room = xrce_creation_room(client);
  uint8_t * end = &room[DELETE_SIZE];
  uint8_t id = XRCE_DELETE;
  uint8_t flags = XRCE_FLAG_LITTLE_ENDIAN;

  entities->due_ms = now + xrce_session_short_pause(now - entities->requested_ms);
  if (!entities->deleting) {
    end = entities_put_object(client, entities->cursor, kind, room);
    id = XRCE_CREATE;
    flags = CREATE_FLAGS;
  }
  xrce_put_submessage(room, id, flags, xrce_size_between(&room[XRCE_SUBMESSAGE_HEADER], end));
  xrce_put_be16(&room[REQUEST_AT], entities->request);
  xrce_put_be16(&room[OBJECT_AT], entities_outstanding_id(client, kind));
  xrce_creation_send(client, xrce_size_between(room, end));
}

/* Returns whether no other place than that of the cursor has work. */
static bool entities_is_one(const xrce_entities_t * entities)
{
  /* cppcheck-suppress knownConditionTrueFalse ; a plan with few places never notes a single one */
  return NOTES_ONE && entities->pending == (uint8_t)XRCE_PENDING_ONE;
}

/* Starts the next request; otherwise there is nothing to do until the next change. */
static void entities_begin(xrce_client_t * client, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;
  size_t left = entities_is_one(entities) ? 1u : (size_t)XRCE_PLACES;

  for (; left != 0u; --left) { /* at most XRCE_PLACES rounds */
    const uint8_t level = client->states[entities->cursor].level;
    const uint8_t goal = entities_goal(client, entities->cursor);

    if (level != goal && entities_is_free(client, entities->cursor, goal)) {
      if (!xrce_creation_begin(client, now)) {
        return;
      }
      entities->deleting = level > goal;
      entities->outstanding = true;
      entities->requested_ms = now;
      entities->request = xrce_session_next_request(&client->session);
      entities_send(client, now);
      return;
    }
    entities_next_place(entities);
  }
  entities->pending = XRCE_PENDING_NONE;
}

void xrce_entities_step(xrce_client_t * client, uint32_t now)
{
  xrce_entities_t * entities = &client->entities;

  if (entities->pending == (uint8_t)XRCE_PENDING_NONE || client->session.state != XRCE_READY) {
    return;
  }
  if (xrce_entities_waits(entities) && !xrce_is_due(now, entities->due_ms)) {
    return;
  }
  entities->resting = false;
  if (entities->outstanding) {
    entities_send(client, now);
  } else {
    entities_begin(client, now);
  }
}

void xrce_entities_on_status(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_entities_t * entities = &client->entities;
  xrce_object_state_t * state = &client->states[entities->cursor];

  if (size < STATUS_SIZE) {
    ++client->session.statistics.malformed;
    return;
  }
  if (
    !entities->outstanding || xrce_get_be16(&payload[0]) != entities->request ||
    xrce_get_be16(&payload[2]) != entities_outstanding_id(client, entities_outstanding_kind(client))) {
    return; /* answer to a repetition, or to a request of another part */
  }
  xrce_creation_end(client);
  entities->outstanding = false;
  if (entities->deleting) {
    --state->level; /* whatever the status: an unknown object is the goal */
  } else if (payload[4] <= XRCE_STATUS_OK_MATCHED) {
    ++state->level;
    entities->refusals = 0;
    if (entities_is_one(entities) && state->level == xrce_place_complete(entities->cursor)) {
      entities->pending = XRCE_PENDING_NONE;
    }
  } else {
    entities_refuse(client, payload[4], now);
  }
  state->stale = state->stale && state->level != 0u;
}

void xrce_entities_add(xrce_client_t * client, uint16_t place)
{
  xrce_entities_t * entities = &client->entities;
  xrce_object_state_t * state = &client->states[place];

  state->wanted = true;
  if (NOTES_ONE && (entities->pending | state->level) == 0u) {
    entities->cursor = place; /* nothing else is due, and creating it makes no work for another place */
    entities->pending = XRCE_PENDING_ONE;
    xrce_turn_change(client);
    return;
  }
  /* Also if the request of a former owner is still outstanding: its result is no longer wanted. */
  if (state->level != 0u || (entities->outstanding && entities->cursor == place)) {
    state->stale = true;
  }
  entities_wake(entities);
  xrce_turn_change(client);
}

void xrce_entities_remove(xrce_client_t * client, uint16_t place)
{
  client->states[place].wanted = false;
  for (uint16_t i = 0; i < (uint16_t)XRCE_ENDPOINTS; ++i) {
    if (client->endpoints[i].participant == place) {
      client->states[MICROROS_NODES_MAX + i].wanted = false;
    }
  }
  entities_wake(&client->entities);
  xrce_turn_change(client);
}

static bool entities_is_done(const xrce_client_t * client, uint16_t place)
{
  const xrce_object_state_t * state = &client->states[place];

  return !state->stale && state->level == entities_goal(client, place);
}

uint8_t xrce_entities_await(xrce_client_t * client, uint16_t place, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();

  client->entities.refused_place = no_place;
  if (xrce_turn_is_mine()) {
    xrce_entities_step(client, start); /* so that the first pump may already find the answer */
  } else {
    xrce_turn_request(client);
  }
  if (timeout_ms == 0u) {
    xrce_session_pump(client); /* the only one: an earlier request may be answered */
  }
  while (!entities_is_done(client, place)) {
    if (client->entities.refused_place == place) {
      return client->entities.refused_status;
    }
    if (port_time_ms() - start >= timeout_ms) {
      return XRCE_SILENT;
    }
    microros_pause();
    xrce_session_pump(client);
  }
  return XRCE_DONE;
}
