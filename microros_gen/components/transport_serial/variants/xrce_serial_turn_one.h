/* SPDX-License-Identifier: Apache-2.0 */
/* The application's port_serial_write may wait for its line. */
#ifndef MICROROS_XRCE_SERIAL_TURN_H
#define MICROROS_XRCE_SERIAL_TURN_H

#include <stdbool.h>

#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A pump begins. */
static inline void xrce_transport_begin_turn(xrce_transport_t * transport)
{
  transport->turn_taken = false;
}

/* Whether a stream may send one more message in this turn: one, since the application's function may wait for its line. */
static inline bool xrce_transport_take_turn(xrce_transport_t * transport)
{
  const bool may_send = !transport->turn_taken;

  transport->turn_taken = true;
  return may_send;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERIAL_TURN_H */
