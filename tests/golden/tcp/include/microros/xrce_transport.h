/* SPDX-License-Identifier: Apache-2.0 */
/* The transport of the session: TCP. Each transport component brings this header with the same functions. */
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

/* How texts name the other end: xrce_transport_name, and xrce_transport_port as %n or %m. */
#define XRCE_PLACE_N "[%s]:%n"
#define XRCE_PLACE_M "[%s]:%m"

typedef struct xrce_transport_t {
  port_tcp_t tcp;
  const char * host; /* the caller's, or the plan's */
  uint16_t port;
  bool gone;              /* the connection broke off, or could not be made; the port has none */
  uint16_t unsent;        /* bytes of `output` that wait for room, from `sent` on */
  uint16_t sent;
  uint16_t size;          /* of the message that arrives, once its length is here */
  uint16_t arrived;       /* bytes of it */
  uint8_t length_arrived; /* bytes of its length */
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

/* Returns what port_wait waits for. */
static inline intptr_t xrce_transport_handle(const xrce_transport_t * transport)
{
  return transport->tcp.handle;
}

/* Whether two transports would share one line: sockets never do. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  (void)a;
  (void)b;
  return false;
}

/* A pump begins. */
static inline void xrce_transport_begin_turn(xrce_transport_t * transport)
{
  (void)transport;
}

/* Whether a stream may send one more message in this turn: sending never waits. */
static inline bool xrce_transport_take_turn(xrce_transport_t * transport)
{
  (void)transport;
  return true;
}

/* Whether who sends may leave received messages to others for now: reading never waits. */
static inline bool xrce_transport_may_skip_reading(const xrce_transport_t * transport, uint32_t pause_ms)
{
  (void)transport;
  (void)pause_ms;
  return false;
}

/* Whether nothing waits to be sent. */
static inline bool xrce_transport_is_idle(xrce_transport_t * transport)
{
  return transport->gone || transport->unsent == 0u;
}

/* Begins to connect, without blocking. False: no network, or no such address. */
bool xrce_transport_open(xrce_transport_t * transport);

void xrce_transport_close(xrce_transport_t * transport);

/*
 * Sends one message without blocking. What the connection has no room for follows with later calls, of receiving too, and so
 * does a first message while the connection is being made. False: it was not taken, and nothing of it is sent.
 */
bool xrce_transport_send(xrce_transport_t * transport, const uint8_t * message, size_t size);

/*
 * Takes one message without blocking. Returns its size, 0 when there is none, -1 for one that had to be thrown away: longer
 * than `capacity`, or empty. `buffer` keeps the part that is there: give the same one until a message came.
 */
int32_t xrce_transport_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

/* Returns how many bytes of the buffer the message on its way has touched at most. */
uint32_t xrce_transport_arrived(const xrce_transport_t * transport);

/* Whether the connection is gone, with the session that the agent had over it. Another one is opened by xrce_transport_open. */
static inline bool xrce_transport_is_gone(const xrce_transport_t * transport)
{
  return transport->gone;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
