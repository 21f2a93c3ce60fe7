/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reliable input stream: messages of the agent on stream 0x80, delivered in order and once each, and
 * acknowledged individually (OMG DDS-XRCE 1.0, 8.4.13). Sequence numbers are modulo 2^16 and start at 0 in
 * each session.
 *
 * A missing message is requested once, with the first acknowledgement after its gap, and again after the
 * next HEARTBEAT: the public agent sends everything that an acknowledgement names, however often it is
 * named.
 *
 * An early message waits in a free slot; without one it is not acknowledged, and the agent repeats it.
 */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_INPUT_H
#define MICROROS_XRCE_STREAM_RELIABLE_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The next message in sequence is handled in the input buffer, so one slot less is needed here. */
enum { XRCE_RELIABLE_INPUT_HELD = MICROROS_RELIABLE_INPUT_SLOTS - 1 };

/* Zero-initialized: an empty stream. */
typedef struct xrce_stream_reliable_input_t {
  uint16_t next;      /* sequence number of the next message */
  uint16_t announced; /* bit i: message next + i is known to exist */
  uint16_t requested;     /* bit i: it was requested since the last HEARTBEAT */
  uint16_t refused;   /* bit i: received early without a free slot: not yet worth requesting */
  uint16_t sequence[XRCE_RELIABLE_INPUT_HELD];
  uint16_t size[XRCE_RELIABLE_INPUT_HELD]; /* 0: the slot is free */
  uint8_t message[XRCE_RELIABLE_INPUT_HELD][MICROROS_RELIABLE_INPUT_SLOT_SIZE];
} xrce_stream_reliable_input_t;

/* Called for a new session: the agent counts from 0. */
void xrce_stream_reliable_input_reset(xrce_stream_reliable_input_t * stream);

/* Accepts a whole message of a stream from 0x80 on, delivers what is in sequence and acknowledges. Returns
 * false for a malformed message. */
bool xrce_stream_reliable_input_take(
  xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now);

/* Handles a HEARTBEAT: messages before its first number are no longer available. Stored messages after
 * that are not delivered from within a message: xrce_stream_reliable_input_continue does that. Returns false
 * for a malformed payload. */
bool xrce_stream_reliable_input_on_heartbeat(
  xrce_client_t * client, const uint8_t * payload, size_t size, uint8_t flags);

/* Delivers stored messages that a HEARTBEAT has put in sequence, and acknowledges. Called after a message
 * of another stream; does nothing if that contained no such HEARTBEAT. */
void xrce_stream_reliable_input_continue(xrce_client_t * client, uint32_t now);

/* --- for this component only: one of xrce_stream_reliable_input_*.c --- */

/* Stores an early message; does nothing without a slot, or if it is already stored. */
void xrce_stream_reliable_input_keep(
  xrce_stream_reliable_input_t * stream, uint16_t sequence, const uint8_t * message, size_t size);

/* Returns the stored message with this number and its size, or NULL. It is removed, and valid until the
 * next one is stored. */
const uint8_t * xrce_stream_reliable_input_kept(
  xrce_stream_reliable_input_t * stream, uint16_t sequence, size_t * size);

/* Returns the stored messages as a map: bit i is message next + i. */
uint16_t xrce_stream_reliable_input_map(const xrce_stream_reliable_input_t * stream);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_INPUT_H */
