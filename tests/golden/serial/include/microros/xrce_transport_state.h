/* SPDX-License-Identifier: Apache-2.0 */
/* State of a serial line: its members and those contributed by other components. */
#ifndef MICROROS_XRCE_TRANSPORT_STATE_H
#define MICROROS_XRCE_TRANSPORT_STATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/xrce_framing.h"

typedef struct xrce_transport_t {
  port_serial_t serial;
  const char * device; /* the caller's, or the plan's */
  xrce_framing_t framing;
} xrce_transport_t;

#endif /* MICROROS_XRCE_TRANSPORT_STATE_H */
