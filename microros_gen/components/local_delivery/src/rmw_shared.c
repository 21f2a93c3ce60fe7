/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_shared.h"

#include "microros/error.h"
#include "microros/port.h"
#include "microros/rmw_decode.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local.h"
#include "microros/rmw_local_deliver.h"
#include "microros/rmw_local_shared.h"
#include "microros/rmw_local_wake.h"
#include "microros/rmw_shared_call.h"
#include "microros/rmw_shared_fan.h"
#include "microros/rmw_shared_ring.h"
#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_gate.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* What this image knows of a ring. */
typedef struct shared_state_t {
  bool follows;  /* the reader has its place since its endpoint was opened */
  bool reported; /* that nothing can arrive */
} shared_state_t;

static shared_state_t shared_states[MICROROS_SHARED_RINGS];

/* Returns the ring of an endpoint, or NULL. */
static const rmw_shared_ring_t * shared_ring(const xrce_endpoint_t * endpoint)
{
  const uint8_t index = rmw_shared_ring_of[endpoint->index];

  return index != (uint8_t)RMW_LOCAL_NONE ? &rmw_shared_rings[index] : NULL;
}

bool rmw_shared_has_ring(const xrce_endpoint_t * endpoint)
{
  return shared_ring(endpoint) != NULL;
}

/* Returns whether the reader of a ring gets a message, and in *count where it is to be; otherwise *result is that of the call. */
static bool shared_may_write(
  const xrce_endpoint_t * writer, const rmw_shared_ring_t * ring, uint32_t * count, rmw_ret_t * result)
{
  rmw_shared_room_t room;

  *result = RMW_RET_OK;
  if (!xrce_gate_is_open(writer)) {
    xrce_drops_add(writer->client, writer->index);
    return false;
  }
  room = rmw_shared_reserve(ring, count);
  if (room == RMW_SHARED_FULL && (writer->qos & XRCE_QOS_RELIABLE) == 0u) {
    xrce_drops_add(writer->client, writer->index);
  } else {
    *result = rmw_shared_error(room, writer->name);
  }
  return room == RMW_SHARED_ROOM;
}

/* Looks from *ring on for the first ring whose reader gets a message; *result is RMW_RET_ERROR if one does not. */
static bool shared_find_room(
  const xrce_endpoint_t * writer, const rmw_shared_ring_t ** ring, uint32_t * count, rmw_ret_t * result)
{
  bool found = shared_may_write(writer, *ring, count, result);
  const rmw_shared_ring_t * next = rmw_shared_next(*ring);

  while (!found && next != NULL && xrce_gate_is_open(writer)) {
    rmw_ret_t other;

    *ring = next;
    found = shared_may_write(writer, next, count, &other);
    *result = other != RMW_RET_OK ? other : *result;
    next = rmw_shared_next(next);
  }
  return found;
}

static uint8_t * shared_body(const rmw_shared_ring_t * ring, uint32_t count)
{
  return (uint8_t *)&rmw_shared_slot(ring, count)[1];
}

/* Copies a message, which the reader of its ring got, to those of the further rings. Returns `result`, or RMW_RET_ERROR. */
static rmw_ret_t shared_spread(
  const xrce_endpoint_t * writer, const rmw_shared_ring_t * ring, uint32_t count, rmw_ret_t result)
{
  const rmw_shared_ring_t * next = rmw_shared_next(ring);
  rmw_ret_t last = result;

  while (next != NULL) {
    const uint32_t size = *rmw_shared_slot(ring, count); /* the slot stays until this image writes it again */
    uint32_t place;
    rmw_ret_t other;

    if (shared_may_write(writer, next, &place, &other)) {
      /* at most 4 * MICROROS_SHARED_WORDS bytes */
      (void)memcpy(shared_body(next, place), shared_body(ring, count), size);
      rmw_shared_commit(next, place, size);
    }
    last = other != RMW_RET_OK ? other : last;
    next = rmw_shared_next(next);
  }
  return last;
}

rmw_ret_t rmw_shared_publish(const xrce_endpoint_t * writer, const void * message)
{
  const rmw_shared_ring_t * ring = shared_ring(writer);
  cdr_fault_t fault; /* set if the message is refused */
  rmw_ret_t result = RMW_RET_ERROR;
  uint32_t count;
  uint32_t size;

  if (ring == NULL || !shared_find_room(writer, &ring, &count, &result)) {
    return result;
  }
  size = writer->type->encode(message, shared_body(ring, count), &fault);
  if (size == 0u) {
    return rmw_encode_refuse(writer->type, &fault);
  }
  rmw_shared_commit(ring, count, size);
  return shared_spread(writer, ring, count, result);
}

rmw_ret_t rmw_shared_publish_body(const xrce_endpoint_t * writer, const uint8_t * body, size_t size)
{
  const rmw_shared_ring_t * ring = shared_ring(writer);
  rmw_ret_t result = RMW_RET_ERROR;
  uint32_t count;

  if (ring == NULL || !shared_find_room(writer, &ring, &count, &result)) {
    return result;
  }
  if (size > writer->type->max_encoded_size) {
    return microros_error_named(RMW_RET_ERROR, microros_error_shared_large, writer->name);
  }
  (void)memcpy(shared_body(ring, count), body, size); /* at most 4 * MICROROS_SHARED_WORDS bytes */
  rmw_shared_commit(ring, count, (uint32_t)size);
  return shared_spread(writer, ring, count, result);
}

static uint8_t shared_queue(const rmw_shared_ring_t * ring)
{
  return rmw_local_queue_of[ring->endpoint - MICROROS_PUBLISHERS_MAX];
}

/* Copies a message from a ring to the queue of its endpoint, which is open. */
static void shared_deliver(xrce_client_t * client, const rmw_shared_ring_t * ring, uint32_t count)
{
  const xrce_endpoint_t * reader = &client->endpoints[ring->endpoint];
  const uint8_t index = shared_queue(ring);
  const rmw_local_queue_t * queue = &rmw_local_queues[index];
  rmw_local_state_t * state = &rmw_local_states[index];
  const uint32_t * slot = rmw_shared_slot(ring, count);
  const uint32_t head = rmw_shared_call_words(ring);
  const uint32_t size = slot[0];
  const uint8_t place = rmw_local_begin(client, queue, state);

  if (
    rmw_shared_call_is_wanted(ring, slot) && size <= (ring->words - 1u - head) * sizeof(uint32_t) &&
    rmw_decode(reader->type, (const uint8_t *)&slot[1u + head], size, false, queue->slot(place)) ==
      RMW_RET_OK) {
    queue->published_ms[place] = port_time_ms();
    rmw_shared_call_note(ring, slot, queue, place);
    ++state->count;
  } else {
    rmw_local_drop(client, queue->receiver);
  }
}

/* Moves the messages that wait, as many as the queue of a service has room for, and returns whether there were any. */
static bool shared_read(xrce_client_t * client, const rmw_shared_ring_t * ring, shared_state_t * state)
{
  const uint8_t index = shared_queue(ring);
  const rmw_local_queue_t * queue = &rmw_local_queues[index];
  rmw_shared_place_t own;
  rmw_shared_place_t writer;
  bool moves = false;

  if (!rmw_local_is_open(client, queue)) {
    rmw_shared_end(ring);
    return false;
  }
  if (!rmw_shared_read(ring, state->follows, &own, &writer)) {
    return false;
  }
  state->follows = true;
  while (own.count != writer.count &&
         (rmw_shared_call_words(ring) == 0u || rmw_local_states[index].count < queue->slots)) {
    shared_deliver(client, ring, own.count);
    rmw_shared_free(ring, &own.count);
    moves = true;
  }
  return moves;
}

void rmw_shared_step(xrce_client_t * client)
{
  bool moves = false;

  if (rmw_shared_look() != RMW_SHARED_ROOM) {
    return; /* an endpoint reports it */
  }
  for (size_t i = 0; i < (size_t)MICROROS_SHARED_RINGS; ++i) {
    const size_t index = rmw_shared_turn(i);

    if (rmw_shared_rings[index].sends) {
      (void)rmw_shared_writer(&rmw_shared_rings[index]); /* a reader follows it before its first message */
    } else if (shared_read(client, &rmw_shared_rings[index], &shared_states[index])) {
      rmw_shared_turned(index);
      moves = true;
    } else {
      /* nothing was written */
    }
  }
  if (moves) {
    rmw_local_wake(); /* the messages may be for another task */
  }
}

/* Ends reading of an endpoint, or of all. */
static void shared_end_of(const xrce_endpoint_t * endpoint)
{
  for (size_t i = 0; i < (size_t)MICROROS_SHARED_RINGS; ++i) {
    const rmw_shared_ring_t * ring = &rmw_shared_rings[i];

    if (!ring->sends && (endpoint == NULL || ring->endpoint == endpoint->index)) {
      shared_states[i].follows = false;
      rmw_shared_end(ring);
    }
  }
}

void rmw_shared_opened(const xrce_endpoint_t * endpoint)
{
  shared_end_of(endpoint); /* what was sent before is not for it */
  rmw_shared_call_opened(endpoint);
}

void rmw_shared_closed(const xrce_endpoint_t * endpoint)
{
  shared_end_of(endpoint);
}

void rmw_shared_leave(void)
{
  shared_end_of(NULL);
  rmw_shared_retry(); /* the next context asks the platform again */
}

bool rmw_shared_is_wrong(const xrce_endpoint_t * reader)
{
  const uint8_t index = rmw_shared_ring_of[reader->index];
  bool is_wrong = false;

  if (index != (uint8_t)RMW_LOCAL_NONE) {
    shared_state_t * state = &shared_states[index];

    is_wrong = rmw_shared_look() != RMW_SHARED_ROOM;
    state->reported = state->reported && is_wrong;
    is_wrong = is_wrong && !state->reported;
  }
  return is_wrong;
}

rmw_ret_t rmw_shared_report(const xrce_endpoint_t * reader)
{
  shared_states[rmw_shared_ring_of[reader->index]].reported = true;
  return rmw_shared_error(rmw_shared_look(), reader->name);
}
