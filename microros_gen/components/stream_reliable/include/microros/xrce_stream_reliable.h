/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reliable output stream: whole messages, encoded in place and kept until the agent acknowledges them, so that
 * sending again is only sending. Sequence numbers are modulo 2^16 and given when a message is sent first. While there
 * is no session the stream keeps what it holds; in the next session its messages are numbered anew and sent again.
 */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_H
#define MICROROS_XRCE_STREAM_RELIABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"
#include "microros/xrce_stream_reliable_send.h"
#include "microros/xrce_stream_reliable_state.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Objects that a new session may have to create, each within its time. What is held goes out before all are there only because
 * of one that stays refused: an agent drops what comes before its writer. */
#define XRCE_HELD_MS \
  ((MICROROS_NODES_MAX + 3u * (MICROROS_PUBLISHERS_MAX + MICROROS_SUBSCRIPTIONS_MAX) + \
    MICROROS_SERVICES_MAX + MICROROS_CLIENTS_MAX) * \
   MICROROS_CREATE_TIMEOUT_MS)

/* Something was acknowledged, or the first message is sent: only what stays unacknowledged gets a HEARTBEAT. */
static inline void xrce_stream_reliable_goes_on(xrce_stream_reliable_t * stream, uint32_t now)
{
  stream->since_ms = now;
  stream->due_ms = now + MICROROS_HEARTBEAT_PERIOD_MS;
}

/* Returns room for MICROROS_RELIABLE_SLOT_SIZE - MICROROS_RELIABLE_FRONT bytes of submessages; NULL: every slot is
 * taken. */
uint8_t * xrce_stream_reliable_reserve(xrce_stream_reliable_t * stream, xrce_session_t * session);

/* Takes `size` bytes of submessages; sends as much as the transport takes where there is a session that is not held. */
void xrce_stream_reliable_commit(
  xrce_stream_reliable_t * stream, xrce_session_t * session, size_t size, uint32_t now);

/* Forgets the oldest message, of which nothing may have been sent if it goes in pieces; else the agent is told at the next
 * step. Returns its submessages; NULL: there is none. They can be read until the next one is reserved. */
const uint8_t * xrce_stream_reliable_drop_oldest(
  xrce_stream_reliable_t * stream, const xrce_session_t * session, uint32_t now);

/* A session is new: holds what is kept, to be numbered from 0, or from what `creation: reliable` has left. */
void xrce_stream_reliable_hold(xrce_stream_reliable_t * stream, uint32_t now);

/* Lets go of what is held once the entities are settled, sends what the transport takes, and a HEARTBEAT when one is due. */
void xrce_stream_reliable_step(
  xrce_stream_reliable_t * stream, xrce_session_t * session, bool settled, uint32_t now);

/* Frees what the agent acknowledges; what it misses is sent in the next step. False: the payload is malformed. */
bool xrce_stream_reliable_on_acknack(
  xrce_stream_reliable_t * stream, xrce_session_t * session, const uint8_t * payload, size_t size,
  uint8_t flags, uint32_t now);

/* For this component alone: tells the agent which numbers can be had, `count` (not 0) from stream->first on. The next time
 * is later the longer nothing was acknowledged. */
void xrce_stream_reliable_heartbeat(
  xrce_stream_reliable_t * stream, xrce_session_t * session, uint16_t count, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_H */
