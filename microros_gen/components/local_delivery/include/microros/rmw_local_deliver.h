/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Delivery to one queue. Inline: for each publisher the plan has a function that delivers to its queues, of which the
 * compiler knows all members. Called with the lock held. Internal.
 */
#ifndef MICROROS_RMW_LOCAL_DELIVER_H
#define MICROROS_RMW_LOCAL_DELIVER_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rmw_local.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline bool rmw_local_is_open(const xrce_client_t * client, const rmw_local_queue_t * queue)
{
  return client->states[XRCE_READERS_AT + queue->receiver].wanted;
}

static inline void rmw_local_drop(xrce_client_t * client, uint16_t receiver)
{
  ++client->receivers[receiver].dropped;
  ++client->session.statistics.dropped;
}

/* Returns a free slot: keep last, a full queue drops its oldest message. */
static inline uint8_t rmw_local_begin(
  xrce_client_t * client, const rmw_local_queue_t * queue, rmw_local_state_t * state)
{
  uint32_t slot;

  if (state->count == queue->slots) {
    rmw_local_pop(queue, state);
    rmw_local_drop(client, queue->receiver);
  }
  slot = (uint32_t)state->head + state->count;
  return (uint8_t)(slot < queue->slots ? slot : slot - queue->slots);
}

/* Delivers to the subscription of a queue if that is open. */
static inline void rmw_local_deliver(
  xrce_client_t * client, const rmw_local_queue_t * queue, rmw_local_state_t * state, const void * message,
  uint32_t now)
{
  if (rmw_local_is_open(client, queue)) {
    const uint8_t slot = rmw_local_begin(client, queue, state);

    if (queue->put(slot, message)) {
      queue->published_ms[slot] = now;
      ++state->count;
    } else {
      rmw_local_drop(client, queue->receiver); /* never: its limits are those of the publisher */
    }
  }
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LOCAL_DELIVER_H */
