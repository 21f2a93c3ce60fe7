/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reliable output stream: a ring of whole messages, encoded in place and kept until the agent
 * acknowledges them, so that sending again is only sending. Sequence numbers are modulo 2^16. While there is
 * no session the ring keeps what it holds; with the next session its messages are numbered from 0 and sent
 * again.
 */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_H
#define MICROROS_XRCE_STREAM_RELIABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All zero is an empty stream. */
typedef struct xrce_stream_reliable_t {
  uint32_t heartbeat_ms;  /* when the next HEARTBEAT is due, while something is unacknowledged */
  uint16_t first;         /* sequence number of the oldest unacknowledged message */
  uint8_t head;           /* its slot */
  uint8_t count;          /* unacknowledged messages */
  bool held;              /* a session is new: nothing is sent until the agent has the writers again, ... */
  uint32_t held_until_ms; /* ... or until then */
  uint16_t size[MICROROS_RELIABLE_SLOTS];
  uint8_t message[MICROROS_RELIABLE_SLOTS][MICROROS_RELIABLE_SLOT_SIZE];
} xrce_stream_reliable_t;

/* Returns room for MICROROS_RELIABLE_SLOT_SIZE - XRCE_MESSAGE_HEADER bytes of submessages; NULL: every slot
 * is taken. */
uint8_t * xrce_stream_reliable_reserve(xrce_stream_reliable_t * stream);

/* Takes `size` bytes of submessages; sends them where there is a session that is not held. */
void xrce_stream_reliable_commit(
  xrce_stream_reliable_t * stream, xrce_session_t * session, size_t size, uint32_t now);

/* Forgets the oldest message and tells the agent at the next step; false: there is none. */
bool xrce_stream_reliable_drop_oldest(xrce_stream_reliable_t * stream, uint32_t now);

/* A session is new: numbers what is kept from 0 and holds it. */
void xrce_stream_reliable_hold(xrce_stream_reliable_t * stream, uint32_t now);

/* Lets go of what is held once the entities are settled, and sends a HEARTBEAT when one is due. */
void xrce_stream_reliable_step(
  xrce_stream_reliable_t * stream, xrce_session_t * session, bool settled, uint32_t now);

/* Frees what the agent acknowledges, sends again what it misses. False: the payload is malformed. */
bool xrce_stream_reliable_on_acknack(
  xrce_stream_reliable_t * stream, xrce_session_t * session, const uint8_t * payload, size_t size,
  uint8_t flags, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_H */
