/* SPDX-License-Identifier: Apache-2.0 */
/* The datagrams of the session: those of the port. The component `seal` replaces this header. Internal. */
#ifndef MICROROS_XRCE_DATAGRAMS_H
#define MICROROS_XRCE_DATAGRAMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/port.h"

/* Whether an agent ends what it has with one socket of a client when another one is used. */
#define XRCE_DATAGRAMS_ONE_SOCKET false

typedef port_udp_t xrce_datagrams_t;

/* Returns the handle for port_wait. */
static inline intptr_t xrce_datagrams_handle(const xrce_datagrams_t * datagrams)
{
  return datagrams->handle;
}

static inline bool xrce_datagrams_open(xrce_datagrams_t * datagrams, const char * host, uint16_t port)
{
  return port_udp_open(datagrams, host, port);
}

static inline void xrce_datagrams_close(xrce_datagrams_t * datagrams)
{
  port_udp_close(datagrams);
}

static inline bool xrce_datagrams_send(xrce_datagrams_t * datagrams, const uint8_t * message, size_t size)
{
  return port_udp_send(datagrams, message, size);
}

static inline int32_t xrce_datagrams_receive(xrce_datagrams_t * datagrams, uint8_t * buffer, size_t capacity)
{
  return port_udp_receive(datagrams, buffer, capacity);
}

#endif /* MICROROS_XRCE_DATAGRAMS_H */
