/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The transport of the session: a serial line. Every transport component provides this header with the
 * same functions. */
#ifndef MICROROS_XRCE_TRANSPORT_H
#define MICROROS_XRCE_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_messages.h"
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

/* For lines that send directly from the slots of the reliable stream: sends a message of at most 65535
 * bytes without a copy. It must stay unchanged until the line is idle or the next function was called.
 * Returns false while another such message is in progress. */
bool xrce_transport_send_kept(xrce_transport_t * transport, const uint8_t * message, size_t size);

/*
 * Called before `message` changes: if it is being sent, it is aborted, and the agent discards the part
 * that it received. */
void xrce_transport_take_back(xrce_transport_t * transport, const uint8_t * message);

/* Returns an upper bound of the bytes of the buffer that the partial message occupies. */
uint32_t xrce_transport_arrived(const xrce_transport_t * transport);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TRANSPORT_H */
