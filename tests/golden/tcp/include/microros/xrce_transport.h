/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The transport of the session: TCP. Every transport component provides this header with the same
 * functions. */
#ifndef MICROROS_XRCE_TRANSPORT_H
#define MICROROS_XRCE_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { XRCE_TCP_PREFIX = 2 };

/* Names of the other end in error texts: xrce_transport_name, and xrce_transport_port as %n or %m. */
#define XRCE_PLACE_N "[%s]:%n"
#define XRCE_PLACE_M "[%s]:%m"

typedef struct xrce_transport_t {
  port_tcp_t tcp;
  const char * host; /* the caller's, or the plan's */
  uint16_t port;
  bool closed;              /* the connection was closed or refused; the port has no socket */
  uint16_t unsent;        /* bytes of `output` that wait for room, from `sent` on */
  uint16_t sent;
  uint16_t size;          /* of the message being received, once its length is known */
  uint16_t arrived;       /* received bytes of it */
  uint8_t length_arrived; /* received bytes of its length */
  uint8_t length[XRCE_TCP_PREFIX];
  uint8_t output[XRCE_TCP_PREFIX + MICROROS_MTU];
} xrce_transport_t;

static inline const char * xrce_transport_name(const xrce_transport_t * transport)
{
  return transport->host;
}

static inline uint16_t xrce_transport_port(const xrce_transport_t * transport)
{
  return transport->port;
}

/* Returns the handle for port_wait. */
static inline intptr_t xrce_transport_handle(const xrce_transport_t * transport)
{
  return transport->tcp.handle;
}

/* Returns whether two transports share one line: sockets never do. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  (void)a;
  (void)b;
  return false;
}

/* Called at the start of a pump. */
static inline void xrce_transport_begin_turn(xrce_transport_t * transport)
{
  (void)transport;
}

/* Returns whether a stream may send another message in this pump: always, since sending never waits. */
static inline bool xrce_transport_take_turn(xrce_transport_t * transport)
{
  (void)transport;
  return true;
}

/* Returns whether a publish may skip reading for now: no, reading never waits. */
static inline bool xrce_transport_may_skip_reading(const xrce_transport_t * transport, uint32_t pause_ms)
{
  (void)transport;
  (void)pause_ms;
  return false;
}

/* Returns whether all data was sent. */
static inline bool xrce_transport_is_idle(xrce_transport_t * transport)
{
  return transport->closed || transport->unsent == 0u;
}

/* Starts to connect, without blocking. Returns false without a network or for an invalid address. */
bool xrce_transport_open(xrce_transport_t * transport);

void xrce_transport_close(xrce_transport_t * transport);

/*
 * Sends one message without blocking. Bytes for which the connection has no room follow with later calls,
 * including receive calls, as does a first message while the connection is being established. Returns
 * false if the message was not accepted; nothing of it is sent then.
 */
bool xrce_transport_send(xrce_transport_t * transport, const uint8_t * message, size_t size);

/*
 * Receives one message without blocking. Returns its size, 0 if none has arrived, -1 for a discarded one: longer than
 * `capacity`, or empty; XRCE_TURN_PARTIAL (xrce_turn_bytes.h): a part of one, and perhaps more. `buffer` keeps a partial message: pass the same one until a message
 * was received.
 */
int32_t xrce_transport_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

/* Returns an upper bound of the bytes of the buffer that the partial message occupies. */
uint32_t xrce_transport_arrived(const xrce_transport_t * transport);

/*
 * Returns whether the connection is closed, and with it the agent's session. xrce_transport_open opens a
 * new one. */
static inline bool xrce_transport_is_broken(const xrce_transport_t * transport)
{
  return transport->closed;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
