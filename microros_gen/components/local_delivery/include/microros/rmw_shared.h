/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rings of messages in memory that the images of one chip share: for each pair of ends of a topic of `local: chip`
 * one, for each client of a service two. One image writes, the other one reads. A message is in its slot as CDR, whose
 * bytes do not depend on the compilers of the images. Internal.
 */
#ifndef MICROROS_RMW_SHARED_H
#define MICROROS_RMW_SHARED_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A ring, from the plan, in words of 4 bytes. */
typedef struct rmw_shared_ring_t {
  uint32_t ends;  /* three words of its writer, three of its reader */
  uint32_t at;    /* the first slot */
  uint32_t words; /* of a slot: the size of the message in bytes, of a call its identity, then the CDR body */
  uint16_t endpoint; /* among the endpoints */
  uint8_t slots;
  bool sends;
} rmw_shared_ring_t;

/* Those of an endpoint are neighbors. A service has two for each client: that of the requests, then that of the
 * replies. */
extern const rmw_shared_ring_t rmw_shared_rings[MICROROS_SHARED_RINGS];

/* The first ring of each endpoint, of a service that of requests, or RMW_LOCAL_NONE. */
extern const uint8_t rmw_shared_ring_of[XRCE_ENDPOINTS];

/* Moves what the other image has written to the queues of endpoints. Called by each pump, with the lock held. */
void rmw_shared_step(xrce_client_t * client);

/* Ends reading: nobody hears what the other image sends. Called with the lock held when the context is shut down. */
void rmw_shared_leave(void);

/* Same for one endpoint, which the application closes. */
void rmw_shared_closed(const xrce_endpoint_t * endpoint);

/* Returns for how long to wait, at most `left` ms: another image need not wake this one. */
static inline uint32_t rmw_shared_left(uint32_t left)
{
  return left > 1u ? 1u : left;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_SHARED_H */
