/* SPDX-License-Identifier: Apache-2.0 */
/* Reading; nobody rests in it. */
#ifndef MICROROS_XRCE_CUSTOM_READ_H
#define MICROROS_XRCE_CUSTOM_READ_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns how many bytes came; a function that says more than it had room for, or -1, has none. */
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
