/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Queues of messages that stay in the image: rings of C structures. The strings and sequences of a waiting message are
 * in the ring's own storage, so a publisher may change its message at once. Internal.
 */
#ifndef MICROROS_RMW_LOCAL_H
#define MICROROS_RMW_LOCAL_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* No queue. */
enum { RMW_LOCAL_NONE = 0xff };

/* Where a local request is from; a reply has that of its request. */
typedef struct rmw_local_origin_t {
  int64_t sequence;
  uint16_t client; /* its index among the clients */
  uint16_t number; /* of the request among those of all clients, as on the wire */
} rmw_local_origin_t;

/* The queue of a subscription, service or client, from the plan. */
typedef struct rmw_local_queue_t {
  void * (*slot)(uint8_t index); /* the message of a slot */

  /* Copies a message to a slot; false: that has too little memory. */
  bool (*put)(uint8_t index, const void * message);

  /* Moves the oldest message to `message`; false: that has too little memory, and the message is lost. */
  bool (*remove)(void * message);
  void (*bind)(void);           /* gives each slot its storage; NULL: the type needs none */
  uint32_t * published_ms;      /* one for each slot, port_time_ms() */
  rmw_local_origin_t * origins; /* one for each slot; NULL for a subscription */
  uint16_t receiver;            /* its index among the endpoints that receive */
  uint8_t slots;
  bool only; /* nothing of the agent */
} rmw_local_queue_t;

/* Where the messages of a publisher go, from the plan. */
typedef struct rmw_local_route_t {
  void (*deliver)(xrce_client_t * client, const void * message); /* a checked one; NULL: to the agent alone */
  const uint8_t * queues;
  uint8_t count;
  bool only;   /* not to the agent */
  bool checks; /* its messages can be above their limits */
} rmw_local_route_t;

/* Messages of a queue that wait. Zero-initialized: none. */
typedef struct rmw_local_state_t {
  uint8_t head; /* slot of the oldest one */
  uint8_t count;
} rmw_local_state_t;

extern const rmw_local_queue_t rmw_local_queues[MICROROS_LOCAL_QUEUES];

/* Outside of the client, whose state is cleared with each session. */
extern rmw_local_state_t rmw_local_states[MICROROS_LOCAL_QUEUES];

/* A table needs a row. */
enum { RMW_LOCAL_ROUTES = MICROROS_PUBLISHERS_MAX == 0u ? 1u : MICROROS_PUBLISHERS_MAX };

/* Of each publisher. */
extern const rmw_local_route_t rmw_local_routes[RMW_LOCAL_ROUTES];

/* The queue of each endpoint that receives, or RMW_LOCAL_NONE. */
extern const uint8_t rmw_local_queue_of[XRCE_RECEIVERS];

/* The queue of the server that each client calls, or RMW_LOCAL_NONE: over the agent. One more than there are clients. */
extern const uint8_t rmw_local_server_of[MICROROS_CLIENTS_MAX + 1u];

/* Called when the application opens an endpoint that receives: what a former owner left is discarded. */
void rmw_local_open(const xrce_endpoint_t * reader);

/* Removes the oldest message of a queue, which has one. */
static inline void rmw_local_pop(const rmw_local_queue_t * queue, rmw_local_state_t * state)
{
  ++state->head;
  if (state->head == queue->slots) {
    state->head = 0;
  }
  --state->count;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LOCAL_H */
