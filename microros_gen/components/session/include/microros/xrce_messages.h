/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The messages of the session: those of the transport as they are. The component `seal` replaces this header. Internal. */
#ifndef MICROROS_XRCE_MESSAGES_H
#define MICROROS_XRCE_MESSAGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct xrce_transport_t;

/* Whether an agent ends what it has with one socket of a client when another one is used. */
#define XRCE_MESSAGES_ONE_SOCKET false

/* --- implemented by the transport --- */

/* See xrce_transport_open, _close, _send and _receive, which have the same arguments and results. */
bool xrce_plain_open(struct xrce_transport_t * transport);
void xrce_plain_close(struct xrce_transport_t * transport);
bool xrce_plain_send(struct xrce_transport_t * transport, const uint8_t * message, size_t size);
int32_t xrce_plain_receive(struct xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

/* --- called by the session --- */

/* Opens the transport without blocking; a custom one waits as long as the function of the application. Returns false if
 * that is not possible, for example without a network or for an invalid address. */
static inline bool xrce_transport_open(struct xrce_transport_t * transport)
{
  return xrce_plain_open(transport);
}

static inline void xrce_transport_close(struct xrce_transport_t * transport)
{
  xrce_plain_close(transport);
}

/* Sends one message without blocking. Returns false if it was not accepted; nothing of it is sent then. */
static inline bool xrce_transport_send(
  struct xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return xrce_plain_send(transport, message, size);
}

/*
 * Receives one message without blocking. Returns its size, 0 if none has arrived, -1 for a discarded one, and
 * XRCE_TURN_PARTIAL (xrce_turn_bytes.h) for a part of one, after which more may be waiting. `buffer` keeps a partial
 * message: pass the same one until a message was received. A custom transport without framing waits a millisecond, unless
 * the application declares that its function only polls. */
static inline int32_t xrce_transport_receive(
  struct xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  return xrce_plain_receive(transport, buffer, capacity);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_MESSAGES_H */
