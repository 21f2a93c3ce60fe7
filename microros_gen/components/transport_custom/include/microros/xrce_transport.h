/* SPDX-License-Identifier: Apache-2.0 */
/* The transport of the session: functions of the application. Each transport component brings this header with the
 * same functions. */
#ifndef MICROROS_XRCE_TRANSPORT_H
#define MICROROS_XRCE_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_custom_reading.h"
#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How texts name the other end. */
#define XRCE_PLACE_N "the custom transport"
#define XRCE_PLACE_M "the custom transport"

static inline const char * xrce_transport_name(const xrce_transport_t * transport)
{
  (void)transport;
  return "";
}

static inline uint16_t xrce_transport_port(const xrce_transport_t * transport)
{
  (void)transport;
  return 0;
}

/* Whether two transports share one line: that which the functions of the application have. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  return a->custom.open == b->custom.open && a->custom.args == b->custom.args;
}

/* A pump begins. */
static inline void xrce_transport_begin_turn(xrce_transport_t * transport)
{
  transport->turn_taken = false;
}

/* Whether a stream may send one more message in this turn: one, since the application's function may wait for its line. */
static inline bool xrce_transport_take_turn(xrce_transport_t * transport)
{
  const bool may_send = !transport->turn_taken;

  transport->turn_taken = true;
  return may_send;
}

/* Whether nothing waits to be sent. */
static inline bool xrce_transport_is_idle(xrce_transport_t * transport)
{
  (void)transport; /* what its function has taken is its own */
  return true;
}

/* Waits as long as the application's function does. False: it says so. */
bool xrce_transport_open(xrce_transport_t * transport);

void xrce_transport_close(xrce_transport_t * transport);

/* Sends one message. False: it was not taken. */
bool xrce_transport_send(xrce_transport_t * transport, const uint8_t * message, size_t size);

/*
 * Takes one message; without framing this waits a millisecond for it, unless the application says that its function only
 * looks. Returns its size, 0 when there is none, -1 for one that had to be thrown away. `buffer` keeps the part that
 * is there: give the same one until a message came.
 */
int32_t xrce_transport_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

/* Returns how many bytes of the buffer the message on its way has touched at most. */
uint32_t xrce_transport_arrived(const xrce_transport_t * transport);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
