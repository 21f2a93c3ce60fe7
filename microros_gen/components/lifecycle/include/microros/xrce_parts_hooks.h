/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by waiting functions, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_PARTS_HOOKS_H
#define MICROROS_XRCE_PARTS_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until a part is sent or repeated, at most `left`. After a sleep none is until the node has its life
 * cycle again. */
static inline uint32_t xrce_parts_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  if (client->parts.body == NULL) {
    return left;
  }
  if (client->parts.outstanding) {
    return xrce_sooner(left, client->parts.due_ms, now);
  }
  return client->parts.busy && client->session.state == (uint8_t)XRCE_READY ? xrce_sooner(left, now, now)
                                                                            : left;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PARTS_HOOKS_H */
