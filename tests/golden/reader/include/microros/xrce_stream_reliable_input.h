/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reliable input stream: what the agent sends on stream 0x80, handed on in order and once each, and acknowledged one
 * by one (OMG DDS-XRCE 1.0, 8.4.13). Sequence numbers are modulo 2^16 and begin at 0 in each session.
 *
 * A missing message is requested once, with the first acknowledgement after its gap, and again after the next HEARTBEAT:
 * the public agent sends all that an acknowledgement names, however often it is named.
 *
 * A message that comes before its turn waits in a slot; without a free one it is not acknowledged, and comes again.
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

/* The message in its turn is handled where it was received, so one slot less is needed here. */
enum { XRCE_RELIABLE_INPUT_HELD = MICROROS_RELIABLE_INPUT_SLOTS - 1 };

/* All zero is an empty stream. */
typedef struct xrce_stream_reliable_input_t {
  uint16_t next;      /* sequence number of the message whose turn it is */
  uint16_t announced; /* bit i: message next + i is known to exist */
  uint16_t asked;     /* bit i: it was requested since the last HEARTBEAT */
  uint16_t refused;   /* bit i: it was received before its turn, without a free slot: no use to request it yet */
  uint16_t sequence[XRCE_RELIABLE_INPUT_HELD];
  uint16_t size[XRCE_RELIABLE_INPUT_HELD]; /* 0: the slot is free */
  uint8_t message[XRCE_RELIABLE_INPUT_HELD][MICROROS_RELIABLE_INPUT_SLOT_SIZE];
} xrce_stream_reliable_input_t;

/* A session is new: the agent counts from 0. */
void xrce_stream_reliable_input_reset(xrce_stream_reliable_input_t * stream);

/* Takes a whole message that came on a stream from 0x80 on, hands on what can be and acknowledges. False: the message is
 * not what it should be. */
bool xrce_stream_reliable_input_take(
  xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now);

/* Takes a HEARTBEAT: what is before its first message cannot be had any more. What is kept behind that is not handed on
 * from within a message: xrce_stream_reliable_input_go_on does that. False: the payload is malformed. */
bool xrce_stream_reliable_input_on_heartbeat(
  xrce_client_t * client, const uint8_t * payload, size_t size, uint8_t flags);

/* Hands on what is kept and whose turn a HEARTBEAT has made it, and acknowledges. For what has taken a message of another
 * stream; does nothing where there was no such HEARTBEAT in it. */
void xrce_stream_reliable_input_go_on(xrce_client_t * client, uint32_t now);

/* --- for this component alone: one of xrce_stream_reliable_input_*.c --- */

/* Keeps a message that came before its turn; does nothing where there is no slot, or it is kept already. */
void xrce_stream_reliable_input_keep(
  xrce_stream_reliable_input_t * stream, uint16_t sequence, const uint8_t * message, size_t size);

/* Returns the kept message with this number and its size, or NULL. It is not kept any more, and stays until the next
 * one is kept. */
const uint8_t * xrce_stream_reliable_input_kept(
  xrce_stream_reliable_input_t * stream, uint16_t sequence, size_t * size);

/* Returns which messages are kept: bit i stands for next + i. */
uint16_t xrce_stream_reliable_input_map(const xrce_stream_reliable_input_t * stream);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_INPUT_H */
