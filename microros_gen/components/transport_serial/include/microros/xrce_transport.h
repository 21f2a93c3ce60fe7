/* SPDX-License-Identifier: Apache-2.0 */
/* The transport of the session: a serial line. Each transport component brings this header with the same functions. */
#ifndef MICROROS_XRCE_TRANSPORT_H
#define MICROROS_XRCE_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_serial_place.h"
#include "microros/xrce_serial_turn.h"
#include "microros/xrce_transport_state.h"

#ifdef __cplusplus
extern "C" {
#endif

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

/* Where the line sends from the reliable stream's own slots: the same for a message of at most 65535 bytes that stays as it is until its line is idle or the
 * next function was called: nothing is copied. False: another one is on its way. */
bool xrce_transport_send_kept(xrce_transport_t * transport, const uint8_t * message, size_t size);

/* `message` is going to change: if it is on its way, it is broken off, and the agent throws away what it has of it. */
void xrce_transport_take_back(xrce_transport_t * transport, const uint8_t * message);

/* Takes one message without blocking. Returns its size, 0 when there is none, -1 for one that had to be thrown
 * away. `buffer` keeps the part that is there: give the same one until a message came. */
int32_t xrce_transport_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

/* Returns how many bytes of the buffer the message on its way has touched at most. */
uint32_t xrce_transport_arrived(const xrce_transport_t * transport);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
