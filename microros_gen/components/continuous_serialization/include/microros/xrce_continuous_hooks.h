/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by waiting functions, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_CONTINUOUS_HOOKS_H
#define MICROROS_XRCE_CONTINUOUS_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until a fragment is repeated or an abandoned message ended, at most `left`. */
static inline uint32_t xrce_continuous_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  const xrce_continuous_t * continuous = &client->continuous;

  if (client->session.state != (uint8_t)XRCE_READY) {
    return left;
  }
  if (continuous->outstanding) {
    return xrce_sooner(left, continuous->due_ms, now);
  }
  return continuous->broken && !continuous->busy ? xrce_sooner(left, now, now) : left;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CONTINUOUS_HOOKS_H */
