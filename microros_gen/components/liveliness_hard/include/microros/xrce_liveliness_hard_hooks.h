/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_LIVELINESS_HARD_HOOKS_H
#define MICROROS_XRCE_LIVELINESS_HARD_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until a sign of life is due, at most `left`. */
static inline uint32_t xrce_liveliness_hard_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  return xrce_sooner(left, client->hard.due_ms, now);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_LIVELINESS_HARD_HOOKS_H */
