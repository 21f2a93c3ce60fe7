/* SPDX-License-Identifier: Apache-2.0 */
/* An endpoint has a ring for each other image that has its other end. Called with the lock held. Internal. */
#ifndef MICROROS_RMW_SHARED_FAN_H
#define MICROROS_RMW_SHARED_FAN_H

#include <stddef.h>
#include <stdint.h>

#include "microros/rmw_shared.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the next ring of the endpoint, of a service that of the requests of its next client; NULL: it has no more. */
const rmw_shared_ring_t * rmw_shared_next(const rmw_shared_ring_t * ring);

/*
 * Returns the index of the ring that is looked at as the `i`-th one, for each `i` from 0 on. Of the rings of an
 * endpoint the one from which messages were moved last comes last: the clients of one image do not keep those of
 * another one from a server that is always busy. */
size_t rmw_shared_turn(size_t i);

/* Called after messages were moved from the ring with this index: in the next round, the one after it comes first. */
void rmw_shared_turned(size_t index);

/*
 * Returns the ring of the replies to a client, by the run of its requests; `requests`: the first ring of the service.
 * NULL: no client has that run any more. */
const rmw_shared_ring_t * rmw_shared_replies(const rmw_shared_ring_t * requests, uint16_t client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_SHARED_FAN_H */
