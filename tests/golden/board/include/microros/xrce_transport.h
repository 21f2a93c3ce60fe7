/* SPDX-License-Identifier: Apache-2.0 */
/* The transport of the session: a serial line. Each transport component brings this header with the same functions. */
#ifndef MICROROS_XRCE_TRANSPORT_H
#define MICROROS_XRCE_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/xrce_framing.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How texts name the other end: xrce_transport_name, and xrce_transport_port as %n or %m. */
#define XRCE_PLACE_N "the serial line"
#define XRCE_PLACE_M "the serial line"

typedef struct xrce_transport_t {
  port_serial_t serial;
  xrce_framing_t framing;
} xrce_transport_t;

static inline const char * xrce_transport_name(const xrce_transport_t * transport)
{
  (void)transport;
  return ""; /* the one that the board has */
}

static inline uint16_t xrce_transport_port(const xrce_transport_t * transport)
{
  (void)transport;
  return 0;
}

/* Returns what port_wait waits for. */
static inline intptr_t xrce_transport_handle(const xrce_transport_t * transport)
{
  return transport->serial.handle;
}

/* Whether two transports share one line. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  (void)a;
  (void)b;
  return true; /* the one that the board has */
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
  return port_serial_is_idle(&transport->serial);
}

/* Does not block. False: there is no such line. */
bool xrce_transport_open(xrce_transport_t * transport);

void xrce_transport_close(xrce_transport_t * transport);

/* Sends one message without blocking: the line carries it while the program goes on. False: it has no room for it, and
 * nothing of it is sent. */
bool xrce_transport_send(xrce_transport_t * transport, const uint8_t * message, size_t size);

/* Takes one message without blocking. Returns its size, 0 when there is none, -1 for one that had to be thrown
 * away. `buffer` keeps the part that is there: give the same one until a message came. */
int32_t xrce_transport_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
