/* SPDX-License-Identifier: Apache-2.0 */
/* Variant: the application's port_serial_write may wait for its line. */
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
  transport->turn_taken = false;
}

/*
 * Returns whether a stream may send another message in this pump: only one, since the application's
 * function may wait for its line. */
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
