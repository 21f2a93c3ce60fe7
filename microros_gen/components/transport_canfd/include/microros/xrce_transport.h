/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The transport of the session: CAN FD. Every transport component provides this header with the same
 * functions. */
#ifndef MICROROS_XRCE_TRANSPORT_H
#define MICROROS_XRCE_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/port_can.h"
#include "microros/text.h"
#include "microros/xrce_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Names of the other end in error texts: xrce_transport_name, and xrce_transport_port as %n or %m. */
#define XRCE_PLACE_N "%s"
#define XRCE_PLACE_M "%s"

typedef struct xrce_transport_t {
  port_can_t can;
  const char * device; /* the caller's, or the plan's */
  uint32_t id;
} xrce_transport_t;

static inline const char * xrce_transport_name(const xrce_transport_t * transport)
{
  return transport->device;
}

static inline uint16_t xrce_transport_port(const xrce_transport_t * transport)
{
  (void)transport;
  return 0;
}

/* Returns the handle for port_wait. */
static inline intptr_t xrce_transport_handle(const xrce_transport_t * transport)
{
  return transport->can.handle;
}

/* Returns whether two transports share one line: they receive the same frames. */
static inline bool xrce_transport_is_same_line(const xrce_transport_t * a, const xrce_transport_t * b)
{
  return a->id == b->id && microros_text_equals(a->device, b->device);
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
  (void)transport;
  return true;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
