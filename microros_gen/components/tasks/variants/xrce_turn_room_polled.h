/* SPDX-License-Identifier: Apache-2.0 */
/* Variant for a transport that must be tried. Internal. */
#ifndef MICROROS_XRCE_TURN_ROOM_H
#define MICROROS_XRCE_TURN_ROOM_H

#include <stdint.h>

#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until a stream tries once more to send what the transport has refused, at most `left`, milliseconds. */
static inline uint32_t xrce_turn_blocked(uint32_t left, uint32_t now)
{
  return xrce_sooner(left, now, now);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TURN_ROOM_H */
