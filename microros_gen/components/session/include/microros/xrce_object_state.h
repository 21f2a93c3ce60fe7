/* SPDX-License-Identifier: Apache-2.0 */
/* State of a client's place. Internal. */
#ifndef MICROROS_XRCE_OBJECT_STATE_H
#define MICROROS_XRCE_OBJECT_STATE_H

#include <stdbool.h>
#include <stdint.h>

/* `level` is the number of objects that exist at the agent, in order of creation. */
typedef struct xrce_object_state_t {
  uint8_t level;
  bool wanted; /* the application has opened it */
  bool stale;  /* objects at the agent belong to a former owner: delete them first */
} xrce_object_state_t;

/* Returns whether the application can open a place. */
static inline bool xrce_place_is_free(const xrce_object_state_t * state)
{
  return !state->wanted;
}

#endif /* MICROROS_XRCE_OBJECT_STATE_H */
