/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The transport of the session: TCP. Every transport component provides this header with the same
 * functions. */
#ifndef MICROROS_XRCE_TRANSPORT_H
#define MICROROS_XRCE_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "microros/port.h"
#include "microros/xrce_largest_sent.h"
#include "microros/xrce_messages.h"
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
  uint8_t output[XRCE_TCP_PREFIX + XRCE_LARGEST_SENT];
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

/* Returns whether two transports cannot be open at once: two connections can, if their agent keeps a session with each. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  return XRCE_MESSAGES_ONE_SOCKET && a->port == b->port && strcmp(a->host, b->host) == 0;
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
