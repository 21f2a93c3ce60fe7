/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_shared.h"

#include "microros/error.h"
#include "microros/port.h"
#include "microros/port_shared.h"
#include "microros/rmw_decode.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local.h"
#include "microros/rmw_local_deliver.h"
#include "microros/rmw_local_shared.h"
#include "microros/rmw_local_wake.h"
#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_gate.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* The memory begins with two words of each image, which say how it was built. Only that image writes them, the mark last. */
enum { SHARED_MARK, SHARED_KEY };

/*
 * Words of an end of a ring. Only its owner writes them; the key is 0 while the others change. A count runs from 0 to twice the
 * slots, so that a full ring differs from an empty one. A writer whose end is not valid begins a run at 0. A reader names the run
 * that it follows, and is not there for the writer of another one: what was in the memory before is never read as messages. */
enum { SHARED_VALID, SHARED_RUN, SHARED_COUNT, SHARED_END_WORDS };

static const uint32_t shared_mark = 0x6d726f73u;

/* Where an end is: how many messages of which run were written or read. */
typedef struct shared_place_t {
  uint32_t run;
  uint32_t count;
} shared_place_t;

/* What this image knows of a ring. */
typedef struct shared_state_t {
  bool follows;  /* the reader has its place since this image started */
  bool reported; /* that nothing can arrive */
} shared_state_t;

static uint32_t * shared_region; /* NULL: not opened */
static shared_state_t shared_states[MICROROS_SHARED_RINGS];

/* Returns whether the other image was built for other rings. */
static bool shared_is_other(void)
{
  const volatile uint32_t * other = &shared_region[MICROROS_SHARED_OTHER];

  return other[SHARED_MARK] == shared_mark && other[SHARED_KEY] != MICROROS_SHARED_KEY;
}

static volatile uint32_t * shared_end(const rmw_shared_ring_t * ring, bool writes)
{
  return &shared_region[ring->ends + (writes ? 0u : (uint32_t)SHARED_END_WORDS)];
}

/* Ends what this image has in the rings: another build may have written anything there. */
static void shared_clear(void)
{
  for (size_t i = 0; i < (size_t)MICROROS_SHARED_RINGS; ++i) {
    const rmw_shared_ring_t * ring = &rmw_shared_rings[i];
    volatile uint32_t * own = shared_end(ring, ring->sends);

    own[SHARED_VALID] = 0;
  }
}

/* Returns whether the platform has the memory; then it says how this image was built. */
static bool shared_open(void)
{
  if (shared_region == NULL) {
    shared_region = port_shared_region(MICROROS_SHARED_WORDS * sizeof(uint32_t));
  }
  if (shared_region != NULL) {
    volatile uint32_t * own = &shared_region[MICROROS_SHARED_OWN];

    if (own[SHARED_MARK] != shared_mark || own[SHARED_KEY] != MICROROS_SHARED_KEY) {
      own[SHARED_MARK] = 0;
      port_shared_barrier();
      shared_clear();
      own[SHARED_KEY] = MICROROS_SHARED_KEY;
      port_shared_barrier();
      own[SHARED_MARK] = shared_mark;
    }
  }
  return shared_region != NULL;
}

/* Returns the slot of the message after `count` ones: its size in bytes, then its body. */
static uint32_t * shared_slot(const rmw_shared_ring_t * ring, uint32_t count)
{
  const uint32_t slot = count < ring->slots ? count : count - ring->slots;

  return &shared_region[ring->at + slot * ring->words];
}

static uint8_t * shared_body(const rmw_shared_ring_t * ring, uint32_t count)
{
  return (uint8_t *)&shared_slot(ring, count)[1];
}

/* Reads where an end is; false: it is not valid. Its owner may begin it again meanwhile, hence it is valid before and after. */
static bool shared_look(const volatile uint32_t * end, const rmw_shared_ring_t * ring, shared_place_t * place)
{
  const uint32_t before = end[SHARED_VALID];

  port_shared_barrier();
  place->run = end[SHARED_RUN];
  place->count = end[SHARED_COUNT];
  port_shared_barrier();
  return before == MICROROS_SHARED_KEY && end[SHARED_VALID] == MICROROS_SHARED_KEY &&
         place->count < 2u * (uint32_t)ring->slots;
}

/* Makes an end of this image valid. */
static void shared_begin(volatile uint32_t * end, const shared_place_t * place)
{
  end[SHARED_VALID] = 0;
  port_shared_barrier();
  end[SHARED_RUN] = place->run;
  end[SHARED_COUNT] = place->count;
  port_shared_barrier();
  end[SHARED_VALID] = MICROROS_SHARED_KEY;
}

/* Returns the ring of an endpoint, or NULL. */
static const rmw_shared_ring_t * shared_ring(const xrce_endpoint_t * endpoint)
{
  const uint8_t index = rmw_shared_ring_of[endpoint->index];

  return index != (uint8_t)RMW_LOCAL_NONE ? &rmw_shared_rings[index] : NULL;
}

static uint32_t shared_next(const rmw_shared_ring_t * ring, uint32_t count)
{
  return count + 1u == 2u * (uint32_t)ring->slots ? 0u : count + 1u;
}

static uint32_t shared_waiting(const rmw_shared_ring_t * ring, uint32_t written, uint32_t read)
{
  return written >= read ? written - read : written + 2u * (uint32_t)ring->slots - read;
}

/* Returns where the writer of this image is. One that restarts goes on: what it wrote before is still to be read. */
static shared_place_t shared_writer(const rmw_shared_ring_t * ring)
{
  volatile uint32_t * end = shared_end(ring, true);
  shared_place_t place;

  if (!shared_look(end, ring, &place)) {
    ++place.run;
    place.count = 0;
    shared_begin(end, &place);
  }
  return place;
}

bool rmw_shared_has_ring(const xrce_endpoint_t * endpoint)
{
  return shared_ring(endpoint) != NULL;
}

/* Returns whether the other image gets a message, and in *count where it is to be; otherwise *result is that of the call. */
static bool shared_may_write(
  const xrce_endpoint_t * writer, const rmw_shared_ring_t * ring, uint32_t * count, rmw_ret_t * result)
{
  shared_place_t own;
  shared_place_t other;

  *result = RMW_RET_OK;
  if (!xrce_gate_is_open(writer)) {
    xrce_drops_add(writer->client, writer->index);
    return false;
  }
  if (!shared_open()) {
    *result = microros_error_named(RMW_RET_ERROR, microros_error_shared_none, writer->name);
    return false;
  }
  if (shared_is_other()) {
    *result = microros_error_named(RMW_RET_ERROR, microros_error_shared_other, writer->name);
    return false;
  }
  own = shared_writer(ring);
  if (!shared_look(shared_end(ring, false), ring, &other) || other.run != own.run) {
    return false; /* the other image has not started */
  }
  *count = own.count;
  if (shared_waiting(ring, own.count, other.count) < ring->slots) {
    return true; /* what is in the slot was read: shared_look ends with a barrier */
  }
  if ((writer->qos & XRCE_QOS_RELIABLE) != 0u) {
    *result = microros_error_named(RMW_RET_ERROR, microros_error_shared_full, writer->name);
  } else {
    xrce_drops_add(writer->client, writer->index);
  }
  return false;
}

/* Gives the message after `count` ones, of `size` bytes, to the other image. */
static void shared_commit(const rmw_shared_ring_t * ring, uint32_t count, uint32_t size)
{
  *shared_slot(ring, count) = size;
  port_shared_barrier();
  shared_end(ring, true)[SHARED_COUNT] = shared_next(ring, count);
  port_shared_notify();
}

rmw_ret_t rmw_shared_publish(const xrce_endpoint_t * writer, const void * message)
{
  const rmw_shared_ring_t * ring = shared_ring(writer);
  cdr_fault_t fault; /* set if the message is refused */
  rmw_ret_t result = RMW_RET_ERROR;
  uint32_t count;
  uint32_t size;

  if (ring == NULL || !shared_may_write(writer, ring, &count, &result)) {
    return result;
  }
  size = writer->type->encode(message, shared_body(ring, count), &fault);
  if (size == 0u) {
    return rmw_encode_refuse(writer->type, &fault);
  }
  shared_commit(ring, count, size);
  return RMW_RET_OK;
}

rmw_ret_t rmw_shared_publish_body(const xrce_endpoint_t * writer, const uint8_t * body, size_t size)
{
  const rmw_shared_ring_t * ring = shared_ring(writer);
  rmw_ret_t result = RMW_RET_ERROR;
  uint32_t count;

  if (ring == NULL || !shared_may_write(writer, ring, &count, &result)) {
    return result;
  }
  if (size > writer->type->max_encoded_size) {
    return microros_error_named(RMW_RET_ERROR, microros_error_shared_large, writer->name);
  }
  (void)memcpy(shared_body(ring, count), body, size);
  shared_commit(ring, count, (uint32_t)size);
  return RMW_RET_OK;
}

/* Copies a message from a ring to the queue of its subscription. */
static void shared_deliver(xrce_client_t * client, const rmw_shared_ring_t * ring, uint32_t count)
{
  const xrce_endpoint_t * reader = &client->endpoints[ring->endpoint];
  const uint8_t index = rmw_local_queue_of[ring->endpoint - MICROROS_PUBLISHERS_MAX];
  const rmw_local_queue_t * queue = &rmw_local_queues[index];
  rmw_local_state_t * state = &rmw_local_states[index];
  const uint32_t size = *shared_slot(ring, count);

  if (rmw_local_is_open(client, queue)) {
    const uint8_t slot = rmw_local_begin(client, queue, state);

    if (
      size <= (ring->words - 1u) * sizeof(uint32_t) &&
      rmw_decode(reader->type, shared_body(ring, count), size, false, queue->slot(slot)) == RMW_RET_OK) {
      queue->published_ms[slot] = port_time_ms();
      ++state->count;
    } else {
      rmw_local_drop(client, queue->receiver);
    }
  }
}

/* Moves the messages that wait, and returns whether there were any. A reader begins where the writer is: what was sent before is
 * not for it. */
static bool shared_read(xrce_client_t * client, const rmw_shared_ring_t * ring, shared_state_t * state)
{
  volatile uint32_t * end = shared_end(ring, false);
  shared_place_t own;
  shared_place_t writer;
  bool moves;

  if (!shared_look(shared_end(ring, true), ring, &writer)) {
    return false;
  }
  if (
    !shared_look(end, ring, &own) || !state->follows || own.run != writer.run ||
    shared_waiting(ring, writer.count, own.count) > ring->slots) {
    own = writer;
    shared_begin(end, &own);
    state->follows = true;
  }
  moves = own.count != writer.count;
  while (own.count != writer.count) {
    shared_deliver(client, ring, own.count);
    own.count = shared_next(ring, own.count);
    port_shared_barrier(); /* the message was read before its slot is free */
    end[SHARED_COUNT] = own.count;
  }
  return moves;
}

void rmw_shared_step(xrce_client_t * client)
{
  bool moves = false;

  if (!shared_open()) {
    return; /* a subscription reports it */
  }
  if (shared_is_other()) {
    shared_clear();
  } else {
    for (size_t i = 0; i < (size_t)MICROROS_SHARED_RINGS; ++i) {
      if (rmw_shared_rings[i].sends) {
        (void)shared_writer(&rmw_shared_rings[i]); /* a reader follows it before its first message */
      } else if (shared_read(client, &rmw_shared_rings[i], &shared_states[i])) {
        moves = true;
      } else {
        /* nothing was written */
      }
    }
  }
  if (moves) {
    rmw_local_wake(); /* the messages may be for another task */
  }
}

bool rmw_shared_is_wrong(const xrce_endpoint_t * reader)
{
  const uint8_t index = rmw_shared_ring_of[reader->index];
  bool is_wrong = false;

  if (index != (uint8_t)RMW_LOCAL_NONE) {
    shared_state_t * state = &shared_states[index];

    is_wrong = !shared_open() || shared_is_other();
    state->reported = state->reported && is_wrong;
    is_wrong = is_wrong && !state->reported;
  }
  return is_wrong;
}

rmw_ret_t rmw_shared_report(const xrce_endpoint_t * reader)
{
  rmw_ret_t result;

  shared_states[rmw_shared_ring_of[reader->index]].reported = true;
  if (shared_region == NULL) {
    result = microros_error_named(RMW_RET_ERROR, microros_error_shared_none, reader->name);
  } else {
    result = microros_error_named(RMW_RET_ERROR, microros_error_shared_other, reader->name);
  }
  return result;
}
