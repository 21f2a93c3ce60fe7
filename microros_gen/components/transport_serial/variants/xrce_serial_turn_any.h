/* SPDX-License-Identifier: Apache-2.0 */
/* Variant: sending never waits. */
#ifndef MICROROS_XRCE_SERIAL_TURN_H
#define MICROROS_XRCE_SERIAL_TURN_H

#include <stdbool.h>

#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called at the start of a pump. */
static inline void xrce_transport_begin_turn(xrce_transport_t * transport)
{
  (void)transport;
}

/* Returns whether a stream may send another message in this pump: always, since sending never waits. */
static inline bool xrce_transport_take_turn(xrce_transport_t * transport)
{
  (void)transport;
  return true;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERIAL_TURN_H */
