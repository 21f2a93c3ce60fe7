/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_LIVELINESS_ACKNACK_HOOKS_H
#define MICROROS_XRCE_LIVELINESS_ACKNACK_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until the session is lost without an acknowledgement, at most `left`. */
static inline uint32_t xrce_liveliness_acknack_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  if (xrce_stream_reliable_is_idle(&client->reliable)) {
    return left;
  }
  return xrce_sooner(left, xrce_liveliness_acknack_due(&client->liveliness), now);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_LIVELINESS_ACKNACK_HOOKS_H */
