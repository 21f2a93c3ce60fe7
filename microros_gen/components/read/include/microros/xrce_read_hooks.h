/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_READ_HOOKS_H
#define MICROROS_XRCE_READ_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until a READ_DATA is due, at most `left`. */
static inline uint32_t xrce_read_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  uint32_t least = left;

  if (client->reading.outstanding) {
    least = xrce_sooner(least, client->reading.due_ms, now);
  }
  for (uint16_t i = 0; i < (uint16_t)XRCE_RECEIVERS; ++i) {
    if (client->receivers[i].resting) {
      least = xrce_sooner(least, client->receivers[i].due_ms, now);
    }
  }
  return least;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_READ_HOOKS_H */
