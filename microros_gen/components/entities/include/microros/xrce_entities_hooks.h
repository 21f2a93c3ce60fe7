/* SPDX-License-Identifier: Apache-2.0 */
/* What the session calls of this component, in the functions that component.yaml names. Internal. */
#ifndef MICROROS_XRCE_ENTITIES_HOOKS_H
#define MICROROS_XRCE_ENTITIES_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the reliable stream is free for what the application writes: no CREATE or DELETE has it. */
static inline bool xrce_entities_leave_stream(const xrce_client_t * client)
{
  return !client->entities.outstanding;
}

/* Returns how long the client can be left alone: `left`, or until a request is due. */
static inline uint32_t xrce_entities_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  if (!client->entities.pending) {
    return left;
  }
  return xrce_sooner(left, xrce_entities_waits(&client->entities) ? client->entities.due_ms : now, now);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ENTITIES_HOOKS_H */
