/* SPDX-License-Identifier: Apache-2.0 */
/* What the session calls of this component, in the functions that component.yaml names. Internal. */
#ifndef MICROROS_XRCE_SERIAL_HOOKS_H
#define MICROROS_XRCE_SERIAL_HOOKS_H

#include "microros/port.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Lets what was handed to the board's UART leave it; that has two bytes at most of its own, of ten bits each. */
static inline void xrce_serial_drain(xrce_client_t * client)
{
  if (xrce_session_drain(client)) {
    port_sleep_ms(1u + 20000u / MICROROS_SERIAL_BAUD);
  }
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERIAL_HOOKS_H */
