/* SPDX-License-Identifier: Apache-2.0 */
/* What the session calls of this component, in the functions that component.yaml names. Internal. */
#ifndef MICROROS_XRCE_LIVELINESS_HARD_HOOKS_H
#define MICROROS_XRCE_LIVELINESS_HARD_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns how long the client can be left alone: `left`, or until it has to show life. */
static inline uint32_t xrce_liveliness_hard_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  return xrce_sooner(left, client->hard.due_ms, now);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_LIVELINESS_HARD_HOOKS_H */
