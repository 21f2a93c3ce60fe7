/* SPDX-License-Identifier: Apache-2.0 */
/* Reading, in which the executor rests. */
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
  const int wait_ms = (int)transport->wait_ms;
  const int longer_ms = wait_ms > timeout_ms ? wait_ms : timeout_ms;
  size_t size;

  transport->wait_ms = 0;
  size = transport->custom.read(&transport->custom, buffer, capacity, longer_ms, &error);

  return size <= capacity ? size : 0u;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CUSTOM_READ_H */
