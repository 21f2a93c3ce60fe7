/* SPDX-License-Identifier: Apache-2.0 */
/* Variant for a transport of the port, whose functions never wait. Internal. */
#ifndef MICROROS_XRCE_TURN_SEND_H
#define MICROROS_XRCE_TURN_SEND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Hands a message to the transport. Returns false if it was not accepted. The caller holds the lock. */
static inline bool xrce_turn_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return xrce_transport_send(transport, message, size);
}

/* Returns whether the transport has every message. The caller holds the lock. */
static inline bool xrce_turn_is_sent(void)
{
  return true;
}

/* Called before the transport is closed, with the lock. Returns the number of best-effort messages that are dropped. */
static inline uint32_t xrce_turn_close(void)
{
  return 0;
}

/* Writes a message without the lock. Returns whether there was one. */
static inline bool xrce_turn_write(xrce_client_t * client)
{
  (void)client;
  return false;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TURN_SEND_H */
