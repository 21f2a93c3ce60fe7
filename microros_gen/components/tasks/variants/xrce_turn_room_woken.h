/* SPDX-License-Identifier: Apache-2.0 */
/* Variant for a transport whose room ends a wait. Internal. */
#ifndef MICROROS_XRCE_TURN_ROOM_H
#define MICROROS_XRCE_TURN_ROOM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until a stream tries once more to send what the transport has refused, at most `left`, milliseconds. */
static inline uint32_t xrce_turn_blocked(uint32_t left, uint32_t now)
{
  (void)now;
  return left;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TURN_ROOM_H */
