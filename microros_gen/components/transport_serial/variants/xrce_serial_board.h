/* SPDX-License-Identifier: Apache-2.0 */
/* Name of the line: the only one of the board. */
#ifndef MICROROS_XRCE_SERIAL_PLACE_H
#define MICROROS_XRCE_SERIAL_PLACE_H

#include <stdbool.h>

#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Names of the other end in error texts. */
#define XRCE_PLACE_N "the serial line"
#define XRCE_PLACE_M "the serial line"

static inline const char * xrce_transport_name(const xrce_transport_t * transport)
{
  (void)transport;
  return "";
}

/* Returns whether two transports share one line: the board has only one. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  (void)a;
  (void)b;
  return true;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERIAL_PLACE_H */
