/* SPDX-License-Identifier: Apache-2.0 */
/* Each endpoint has one ring, or two for requests and replies: there is one other image. Internal. */
#ifndef MICROROS_RMW_SHARED_FAN_H
#define MICROROS_RMW_SHARED_FAN_H

#include <stddef.h>
#include <stdint.h>

#include "microros/rmw_shared.h"

/* Returns the next ring of the endpoint, of a service that of the requests of its next client; NULL: it has no more. */
static inline const rmw_shared_ring_t * rmw_shared_next(const rmw_shared_ring_t * ring)
{
  (void)ring;
  return NULL;
}

/* Returns the index of the ring that is looked at as the `i`-th one. */
static inline size_t rmw_shared_turn(size_t i)
{
  return i;
}

static inline void rmw_shared_turned(size_t index)
{
  (void)index;
}

/* Returns the ring of the replies to a client, of which `requests` is that of its requests. */
static inline const rmw_shared_ring_t * rmw_shared_replies(
  const rmw_shared_ring_t * requests, uint16_t client)
{
  (void)client;
  return &requests[1];
}

#endif /* MICROROS_RMW_SHARED_FAN_H */
