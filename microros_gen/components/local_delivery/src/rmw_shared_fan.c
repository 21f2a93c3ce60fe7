/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_shared_fan.h"

#include "microros/rmw_shared_call.h"
#include "microros/rmw_shared_ring.h"

static size_t fan_first; /* the ring that is looked at first */

const rmw_shared_ring_t * rmw_shared_next(const rmw_shared_ring_t * ring)
{
  const rmw_shared_ring_t * next =
    &ring[rmw_shared_call_words(ring) == 0u ? 1 : 2]; /* after that of the replies */

  return next < &rmw_shared_rings[MICROROS_SHARED_RINGS] && next->endpoint == ring->endpoint ? next : NULL;
}

size_t rmw_shared_turn(size_t i)
{
  const size_t index = fan_first + i;

  return index < (size_t)MICROROS_SHARED_RINGS ? index : index - (size_t)MICROROS_SHARED_RINGS;
}

void rmw_shared_turned(void)
{
  fan_first = rmw_shared_turn(1);
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
