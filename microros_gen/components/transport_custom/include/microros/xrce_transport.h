/* SPDX-License-Identifier: Apache-2.0 */
/* The transport of the session: functions of the application. Every transport component provides this
 * header with the same functions. */
#ifndef MICROROS_XRCE_TRANSPORT_H
#define MICROROS_XRCE_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_custom_reading.h"
#include "microros/xrce_messages.h"
#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Names of the other end in error texts. */
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

/* Returns whether two transports share one line: all use the application's functions. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  return a->custom.open == b->custom.open && a->custom.args == b->custom.args;
}

/* Called at the start of a pump. */
static inline void xrce_transport_begin_turn(xrce_transport_t * transport)
{
  transport->turn_taken = false;
}

/*
 * Returns whether a stream may send another message in this pump: only one, since the application's
 * function may wait for its line. */
static inline bool xrce_transport_take_turn(xrce_transport_t * transport)
{
  const bool may_send = !transport->turn_taken;

  transport->turn_taken = true;
  return may_send;
}

/* Returns whether all data was sent. */
static inline bool xrce_transport_is_idle(xrce_transport_t * transport)
{
  (void)transport; /* the application's function owns accepted data */
  return true;
}

/* Returns an upper bound of the bytes of the buffer that the partial message occupies. */
uint32_t xrce_transport_arrived(const xrce_transport_t * transport);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
