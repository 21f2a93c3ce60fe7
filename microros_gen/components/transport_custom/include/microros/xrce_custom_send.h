/* SPDX-License-Identifier: Apache-2.0 */
/* Sending without framing. */
#ifndef MICROROS_XRCE_CUSTOM_SEND_H
#define MICROROS_XRCE_CUSTOM_SEND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline bool xrce_custom_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  uint8_t error = 0;

  return transport->custom.write(&transport->custom, message, size, &error) == size;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CUSTOM_SEND_H */
