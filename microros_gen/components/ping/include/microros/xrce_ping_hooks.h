/* SPDX-License-Identifier: Apache-2.0 */
/* What the session calls of this component, in the functions that component.yaml names. Internal. */
#ifndef MICROROS_XRCE_PING_HOOKS_H
#define MICROROS_XRCE_PING_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns how long the client can be left alone: `left`, or until the agent is to be asked. */
static inline uint32_t xrce_ping_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  return xrce_sooner(
    left,
    client->ping.unanswered != 0u ? client->ping.due_ms
                                  : client->session.heard_ms + MICROROS_LIVELINESS_PERIOD_MS,
    now);
}

/* The device has slept: the agent is asked in the first pump. */
static inline void xrce_ping_wake(xrce_client_t * client, uint32_t now)
{
  client->session.heard_ms = now - MICROROS_LIVELINESS_PERIOD_MS;
  client->ping.unanswered = 0;
  client->ping.due_ms = now;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PING_HOOKS_H */
