/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by waiting functions, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_PIECES_HOOKS_H
#define MICROROS_XRCE_PIECES_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until a piece is sent or repeated, at most `left`. */
static inline uint32_t xrce_pieces_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  if (client->pieces.outstanding) {
    return xrce_sooner(left, client->pieces.due_ms, now);
  }
  return client->pieces.busy && client->session.state == (uint8_t)XRCE_READY ? xrce_sooner(left, now, now)
                                                                             : left;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PIECES_HOOKS_H */
