/* SPDX-License-Identifier: Apache-2.0 */
/* What the client knows of one of its places. Internal. */
#ifndef MICROROS_XRCE_OBJECT_STATE_H
#define MICROROS_XRCE_OBJECT_STATE_H

#include <stdbool.h>
#include <stdint.h>

/* `level` counts the objects that exist at the agent, in the order of their creation. */
typedef struct xrce_object_state_t {
  uint8_t level;
  bool wanted; /* the application has it open */
  bool stale;  /* what is at the agent belongs to a former owner of this place: delete it first */
} xrce_object_state_t;

/* Whether the application can open a place. */
static inline bool xrce_place_is_free(const xrce_object_state_t * state)
{
  return !state->wanted;
}

#endif /* MICROROS_XRCE_OBJECT_STATE_H */
