/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_ENTITIES_HOOKS_H
#define MICROROS_XRCE_ENTITIES_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the agent holds every wanted entity. */
static inline bool xrce_entities_settled(const xrce_client_t * client)
{
  return client->entities.pending == (uint8_t)XRCE_PENDING_NONE;
}

/* Returns whether the application may write to the reliable stream: no CREATE or DELETE occupies it. */
static inline bool xrce_entities_leave_stream(const xrce_client_t * client)
{
  return !client->entities.outstanding;
}

/* Returns the time until a request is due, at most `left`. */
static inline uint32_t xrce_entities_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  if (client->entities.pending == (uint8_t)XRCE_PENDING_NONE) {
    return left;
  }
  return xrce_sooner(left, xrce_entities_waits(&client->entities) ? client->entities.due_ms : now, now);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ENTITIES_HOOKS_H */
