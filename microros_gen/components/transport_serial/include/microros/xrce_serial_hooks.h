/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_SERIAL_HOOKS_H
#define MICROROS_XRCE_SERIAL_HOOKS_H

#include "microros/port.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Waits until the board's UART has sent everything; it buffers at most two bytes of ten bits each. */
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
