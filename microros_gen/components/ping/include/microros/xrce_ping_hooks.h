/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_PING_HOOKS_H
#define MICROROS_XRCE_PING_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until a request is due, at most `left`. */
static inline uint32_t xrce_ping_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  return xrce_sooner(
    left,
    client->ping.unanswered != 0u ? client->ping.due_ms
                                  : client->session.received_ms + MICROROS_LIVELINESS_PERIOD_MS,
    now);
}

/* After a sleep of the device the first pump sends a request. */
static inline void xrce_ping_wake(xrce_client_t * client, uint32_t now)
{
  client->session.received_ms = now - MICROROS_LIVELINESS_PERIOD_MS;
  client->ping.unanswered = 0;
  client->ping.due_ms = now;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PING_HOOKS_H */
