/* SPDX-License-Identifier: Apache-2.0 */
/* Name of the line: a device. */
#ifndef MICROROS_XRCE_SERIAL_PLACE_H
#define MICROROS_XRCE_SERIAL_PLACE_H

#include <stdbool.h>

#include "microros/text.h"
#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Names of the other end in error texts: xrce_transport_name, and xrce_transport_port as %n or %m. */
#define XRCE_PLACE_N "%s"
#define XRCE_PLACE_M "%s"

static inline const char * xrce_transport_name(const xrce_transport_t * transport)
{
  return transport->device;
}

/* Returns whether two transports share one line. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  return microros_text_equals(a->device, b->device);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERIAL_PLACE_H */
