/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A port whose clock is a counter of milliseconds with 32 bits finds out in port_time_steady_ns that it has wrapped, so one
 * wrap in which nobody asks would be lost. Here each half of the counter is noticed, and the function called. Internal.
 */
#ifndef MICROROS_XRCE_LONG_TIME_H
#define MICROROS_XRCE_LONG_TIME_H

#include "microros/port.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* In each pump; `now` is port_time_ms. */
static inline void xrce_long_time_step(xrce_client_t * client, uint32_t now)
{
  const uint8_t half = (uint8_t)(1u + (now >> 31));

  if (client->time_half != half) {
    client->time_half = half;
    (void)port_time_steady_ns();
  }
}

/* A wait ends within half of a half, so that none is slept through. */
static inline uint32_t xrce_long_time_left(uint32_t left)
{
  static const uint32_t most_ms = 0x40000000u; /* 12.4 days */

  return left < most_ms ? left : most_ms;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_LONG_TIME_H */
