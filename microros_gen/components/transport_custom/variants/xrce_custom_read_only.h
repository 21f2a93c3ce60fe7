/* SPDX-License-Identifier: Apache-2.0 */
/* Reading without resting. */
#ifndef MICROROS_XRCE_CUSTOM_READ_H
#define MICROROS_XRCE_CUSTOM_READ_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the number of received bytes; a result above `capacity`, such as -1, counts as none. */
static inline size_t xrce_custom_read(
  xrce_transport_t * transport, uint8_t * buffer, size_t capacity, int timeout_ms)
{
  uint8_t error = 0;
  const size_t size = transport->custom.read(&transport->custom, buffer, capacity, timeout_ms, &error);

  return size <= capacity ? size : 0u;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CUSTOM_READ_H */
