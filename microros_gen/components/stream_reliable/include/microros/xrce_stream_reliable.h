/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reliable output stream: whole messages, encoded in place and stored until the agent acknowledges
 * them, so that repetition only sends. Sequence numbers are modulo 2^16 and assigned when a message is
 * first sent. Without a session the stream keeps its messages; in the next session they are renumbered and
 * sent again.
 */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_H
#define MICROROS_XRCE_STREAM_RELIABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_mark.h"
#include "microros/xrce_session.h"
#include "microros/xrce_stream_reliable_drop.h"
#include "microros/xrce_stream_reliable_send.h"
#include "microros/xrce_stream_reliable_state.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Limit for holding messages back after a reconnection: the time to create all objects of a session. It
 * only expires if an object stays refused; an agent drops messages that arrive before their writer exists. */
#define XRCE_HELD_MS \
  ((uint32_t)MICROROS_CREATE_TIMEOUT_MS * \
   (MICROROS_NODES_MAX + 3u * (MICROROS_PUBLISHERS_MAX + MICROROS_SUBSCRIPTIONS_MAX) + \
    MICROROS_SERVICES_MAX + MICROROS_CLIENTS_MAX))

/*
 * Called for an acknowledgement or the first message: a HEARTBEAT is only needed for messages that stay
 * unacknowledged. */
static inline void xrce_stream_reliable_restart_timer(xrce_stream_reliable_t * stream, uint32_t now)
{
  stream->since_ms = now;
  stream->due_ms = now + MICROROS_HEARTBEAT_PERIOD_MS;
}

/* Returns room for MICROROS_RELIABLE_SLOT_SIZE - MICROROS_RELIABLE_FRONT bytes of submessages; NULL if all
 * slots are in use. */
uint8_t * xrce_stream_reliable_reserve(xrce_stream_reliable_t * stream, xrce_session_t * session);

/*
 * Stores `size` bytes of submessages; sends as much as the transport accepts, unless there is no session
 * or messages are held back. */
void xrce_stream_reliable_commit(
  xrce_stream_reliable_t * stream, xrce_session_t * session, size_t size, uint32_t now);

/*
 * Called for a new session: holds back stored messages, to be numbered from 0, or from the next number
 * after those of `creation: reliable`. */
void xrce_stream_reliable_hold(xrce_stream_reliable_t * stream, uint32_t now);

/*
 * Releases held messages once the entities are settled, sends as much as the transport accepts, and a
 * HEARTBEAT when it is due. */
void xrce_stream_reliable_step(
  xrce_stream_reliable_t * stream, xrce_session_t * session, bool settled, uint32_t now);

/*
 * Frees acknowledged messages; missing ones are sent in the next step. Returns false for a malformed
 * payload. */
bool xrce_stream_reliable_on_acknack(
  xrce_stream_reliable_t * stream, xrce_session_t * session, const uint8_t * payload, size_t size,
  uint8_t flags, uint32_t now);

/* Returns whether every message is acknowledged that was stored at the first look with `mark`. */
bool xrce_stream_reliable_has_passed(
  const xrce_stream_reliable_t * stream, const xrce_session_t * session, xrce_mark_t * mark);

/* For this component only: sends a HEARTBEAT with the available numbers, `count` (not 0) from
 * stream->first on. Its interval grows while nothing is acknowledged. Returns false if the transport refused it. */
bool xrce_stream_reliable_heartbeat(
  xrce_stream_reliable_t * stream, xrce_session_t * session, uint16_t count, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_H */
