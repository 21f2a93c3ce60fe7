/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_shared_fan.h"

#include "microros/rmw_shared_call.h"
#include "microros/rmw_shared_ring.h"

/* By the first ring of an endpoint: how many of its rings are looked at after the others. */
static uint8_t fan_turns[MICROROS_SHARED_RINGS];

const rmw_shared_ring_t * rmw_shared_next(const rmw_shared_ring_t * ring)
{
  const rmw_shared_ring_t * next =
    &ring[rmw_shared_call_words(ring) == 0u ? 1 : 2]; /* after that of the replies */

  return next < &rmw_shared_rings[MICROROS_SHARED_RINGS] && next->endpoint == ring->endpoint ? next : NULL;
}

/* Returns the index of the first ring of the endpoint that has this one. */
static size_t fan_begin(size_t index)
{
  return rmw_shared_ring_of[rmw_shared_rings[index].endpoint];
}

/* Returns the index after the last ring of the endpoint that has this one. */
static size_t fan_end(size_t index)
{
  size_t end = index + 1u;

  while (end < (size_t)MICROROS_SHARED_RINGS &&
         rmw_shared_rings[end].endpoint == rmw_shared_rings[index].endpoint) {
    ++end;
  }
  return end;
}

size_t rmw_shared_turn(size_t i)
{
  static uint8_t turn; /* of this endpoint: the order of its rings stays the same to its last one */
  const size_t begin = fan_begin(i);
  const size_t end = fan_end(i);
  size_t index;

  if (i == begin) {
    turn = fan_turns[begin];
  }
  index = i + turn;
  return index < end ? index : begin + (index - end);
}

void rmw_shared_turned(size_t index)
{
  const size_t begin = fan_begin(index);
  const size_t next = index + 1u;

  fan_turns[begin] = next < fan_end(index) ? (uint8_t)(next - begin) : 0u;
}

const rmw_shared_ring_t * rmw_shared_replies(const rmw_shared_ring_t * requests, uint16_t client)
{
  const rmw_shared_ring_t * ring = requests;
  const rmw_shared_ring_t * found = NULL;

  if (rmw_shared_look() != RMW_SHARED_ROOM) {
    return &requests[1]; /* writing to it gives the error */
  }
  while (ring != NULL && found == NULL) {
    rmw_shared_place_t own;
    rmw_shared_place_t writer;

    if (rmw_shared_read(ring, true, &own, &writer) && (writer.run & UINT16_MAX) == client) {
      found = &ring[1];
    }
    ring = rmw_shared_next(ring);
  }
  return found;
}
