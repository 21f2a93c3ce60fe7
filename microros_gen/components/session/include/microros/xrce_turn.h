/* SPDX-License-Identifier: Apache-2.0 */
/* Which task receives and sends: every one that calls the library. A component with a task for the session replaces this
 * header. The caller holds the lock of the library. Internal. */
#ifndef MICROROS_XRCE_TURN_H
#define MICROROS_XRCE_TURN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_transport.h"
#include "microros/xrce_turn_change.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Messages that a pump receives at most, so that a flood cannot block the client. */
enum { XRCE_TURN_MESSAGES = 32 };

/* Returns whether the calling task may receive and send. */
static inline bool xrce_turn_is_mine(void)
{
  return true;
}

/* The same; if it is another task's turn, the time of the session is now, for what the caller stores. */
static inline bool xrce_turn_begin(const xrce_client_t * client)
{
  (void)client;
  return true;
}

/* Asks the task whose turn it is to receive and send. */
static inline void xrce_turn_request(const xrce_client_t * client)
{
  (void)client;
}

/* A message outside of all streams, which whoever asks the agent sends itself, is between these two. */
static inline void xrce_turn_borrow(void)
{
}

static inline void xrce_turn_return(const xrce_client_t * client)
{
  (void)client;
}

/* Returns whether a submessage with so many bytes of payload is taken after another one of its message. */
static inline bool xrce_turn_takes(size_t length)
{
  (void)length;
  return true;
}

/* Returns the time until a stream tries once more to send what the transport has refused, at most `left`, milliseconds. */
static inline uint32_t xrce_turn_blocked(uint32_t left, uint32_t now)
{
  return xrce_sooner(left, now, now);
}

/* Hands a message to the transport. Returns false if it was not accepted. */
static inline bool xrce_turn_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return xrce_transport_send(transport, message, size);
}

/* Returns whether the transport has every message. */
static inline bool xrce_turn_is_sent(void)
{
  return true;
}

/* Called before the transport is closed. Returns the number of best-effort messages that are dropped. */
static inline uint32_t xrce_turn_close(void)
{
  return 0;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TURN_H */
