/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_shared_ring.h"

#include "microros/error.h"
#include "microros/port_shared.h"
#include "microros/rmw_shared_sign.h"

#include <stddef.h>

/*
 * Words of an end of a ring. Only its owner writes them; the key is 0 while the others change. A count runs from 0 to twice the
 * slots, so that a full ring differs from an empty one. A writer whose end is not valid begins a run at 0. A reader names the run
 * that it follows, and is not there for the writer of another one: what was in the memory before is never read as messages. */
enum { SHARED_VALID, SHARED_RUN, SHARED_COUNT, SHARED_END_WORDS };

static uint32_t * shared_region; /* NULL: not opened, or the platform has no such memory */
static bool shared_is_absent;    /* the platform said so */

static volatile uint32_t * shared_end(const rmw_shared_ring_t * ring, bool writes)
{
  return &shared_region[ring->ends + (writes ? 0u : (uint32_t)SHARED_END_WORDS)];
}

void rmw_shared_end(const rmw_shared_ring_t * ring)
{
  if (shared_region != NULL && rmw_shared_may_end(shared_region)) {
    volatile uint32_t * own = shared_end(ring, ring->sends);

    own[SHARED_VALID] = 0;
  }
}

void rmw_shared_retry(void)
{
  shared_is_absent = false;
}

rmw_shared_room_t rmw_shared_look(void)
{
  if (shared_region == NULL && !shared_is_absent) {
    shared_region = port_shared_region(MICROROS_SHARED_WORDS * sizeof(uint32_t));
    shared_is_absent = shared_region == NULL;
  }
  if (shared_region == NULL) {
    return RMW_SHARED_NONE;
  }
  return rmw_shared_agrees(shared_region) ? RMW_SHARED_ROOM : RMW_SHARED_OTHER;
}

uint32_t * rmw_shared_slot(const rmw_shared_ring_t * ring, uint32_t count)
{
  const uint32_t slot = count < ring->slots ? count : count - ring->slots;

  return &shared_region[ring->at + slot * ring->words];
}

/* Reads where an end is; false: it is not valid. Its owner may begin it again meanwhile, hence it is valid before and after. */
static bool shared_place(
  const volatile uint32_t * end, const rmw_shared_ring_t * ring, rmw_shared_place_t * place)
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
static void shared_begin(volatile uint32_t * end, const rmw_shared_place_t * place)
{
  end[SHARED_VALID] = 0;
  port_shared_barrier();
  end[SHARED_RUN] = place->run;
  end[SHARED_COUNT] = place->count;
  port_shared_barrier();
  end[SHARED_VALID] = MICROROS_SHARED_KEY;
}

static uint32_t shared_next(const rmw_shared_ring_t * ring, uint32_t count)
{
  return count + 1u == 2u * (uint32_t)ring->slots ? 0u : count + 1u;
}

static uint32_t shared_waiting(const rmw_shared_ring_t * ring, uint32_t written, uint32_t read)
{
  return written >= read ? written - read : written + 2u * (uint32_t)ring->slots - read;
}

rmw_shared_place_t rmw_shared_writer(const rmw_shared_ring_t * ring)
{
  rmw_shared_place_t place;

  if (!shared_place(shared_end(ring, true), ring, &place)) {
    rmw_shared_renew(ring);
    (void)shared_place(shared_end(ring, true), ring, &place);
  }
  return place;
}

void rmw_shared_renew(const rmw_shared_ring_t * ring)
{
  volatile uint32_t * end = shared_end(ring, true);
  const rmw_shared_place_t place = {.run = rmw_shared_next_run(end[SHARED_RUN]), .count = 0};

  shared_begin(end, &place);
}

rmw_shared_room_t rmw_shared_reserve(const rmw_shared_ring_t * ring, uint32_t * count)
{
  const rmw_shared_room_t room = rmw_shared_look();
  rmw_shared_place_t own;
  rmw_shared_place_t other;

  if (room != RMW_SHARED_ROOM) {
    return room;
  }
  own = rmw_shared_writer(ring);
  *count = own.count;
  if (!shared_place(shared_end(ring, false), ring, &other) || other.run != own.run) {
    return RMW_SHARED_ABSENT;
  }
  return shared_waiting(ring, own.count, other.count) < ring->slots
           ? RMW_SHARED_ROOM /* what is in the slot was read: shared_place ends with a barrier */
           : RMW_SHARED_FULL;
}

void rmw_shared_commit(const rmw_shared_ring_t * ring, uint32_t count, uint32_t size)
{
  *rmw_shared_slot(ring, count) = size;
  port_shared_barrier();
  shared_end(ring, true)[SHARED_COUNT] = shared_next(ring, count);
  port_shared_notify();
}

bool rmw_shared_read(
  const rmw_shared_ring_t * ring, bool follows, rmw_shared_place_t * own, rmw_shared_place_t * writer)
{
  volatile uint32_t * end = shared_end(ring, false);

  if (!shared_place(shared_end(ring, true), ring, writer)) {
    return false;
  }
  if (
    !follows || !shared_place(end, ring, own) || own->run != writer->run ||
    shared_waiting(ring, writer->count, own->count) > ring->slots) {
    *own = *writer;
    shared_begin(end, own);
  }
  return true;
}

void rmw_shared_free(const rmw_shared_ring_t * ring, uint32_t * count)
{
  *count = shared_next(ring, *count);
  port_shared_barrier(); /* the message was read before its slot is free */
  shared_end(ring, false)[SHARED_COUNT] = *count;
}

rmw_ret_t rmw_shared_error(rmw_shared_room_t room, const char * name)
{
  switch (room) {
    case RMW_SHARED_FULL:
      return microros_error_named(RMW_RET_ERROR, microros_error_shared_full, name);
    case RMW_SHARED_OTHER:
      return microros_error_named(RMW_RET_ERROR, microros_error_shared_other, name);
    case RMW_SHARED_NONE:
      return microros_error_named(RMW_RET_ERROR, microros_error_shared_none, name);
    case RMW_SHARED_ROOM:
    case RMW_SHARED_ABSENT:
    default:
      return RMW_RET_OK;
  }
}
