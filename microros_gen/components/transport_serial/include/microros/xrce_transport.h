/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The transport of the session: a serial line. Every transport component provides this header with the
 * same functions. */
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

/* Returns the handle for port_wait. */
static inline intptr_t xrce_transport_handle(const xrce_transport_t * transport)
{
  return transport->serial.handle;
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
  return port_serial_is_idle(&transport->serial);
}

/* Opens the line; returns false if it does not exist. Does not block. */
bool xrce_transport_open(xrce_transport_t * transport);

void xrce_transport_close(xrce_transport_t * transport);

/* Sends one message without blocking: the line transmits it in the background. Returns false if the line
 * has no room for it; nothing of it is sent then. */
bool xrce_transport_send(xrce_transport_t * transport, const uint8_t * message, size_t size);

/* For lines that send directly from the slots of the reliable stream: sends a message of at most 65535
 * bytes without a copy. It must stay unchanged until the line is idle or the next function was called.
 * Returns false while another such message is in progress. */
bool xrce_transport_send_kept(xrce_transport_t * transport, const uint8_t * message, size_t size);

/*
 * Called before `message` changes: if it is being sent, it is aborted, and the agent discards the part
 * that it received. */
void xrce_transport_take_back(xrce_transport_t * transport, const uint8_t * message);

/* Receives one message without blocking. Returns its size, 0 if none has arrived, -1 for a discarded one,
 * XRCE_TURN_PARTIAL as xrce_framing_receive. `buffer` keeps a partial message: pass the same one until a message was received. */
int32_t xrce_transport_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

/* Returns an upper bound of the bytes of the buffer that the partial message occupies. */
uint32_t xrce_transport_arrived(const xrce_transport_t * transport);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
