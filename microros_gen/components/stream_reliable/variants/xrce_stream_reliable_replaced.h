/* SPDX-License-Identifier: Apache-2.0 */
/* State of the reliable output stream if every message fits into MICROROS_MTU, and a newer one replaces the oldest one
 * that was not sent (`on_full: drop_oldest`). */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_STATE_H
#define MICROROS_XRCE_STREAM_RELIABLE_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Zero-initialized: an empty stream. Its slots are not part of the state: only the stream's own source
 * depends on their size and number. */
typedef struct xrce_stream_reliable_t {
  uint32_t due_ms;   /* next HEARTBEAT while something is unacknowledged; while held: the limit */
  uint32_t since_ms; /* time of the last acknowledgement, or of the first message */
  bool held;         /* until due_ms, or until the agent has the writers, nothing is numbered or sent */
  bool gap;          /* a message that was sent is gone: the next thing to send is a HEARTBEAT */
  uint8_t count;     /* unacknowledged messages */
  uint8_t sent;      /* of them: those with a number, from `first` on */
  uint16_t first;    /* oldest number in use; the next one to assign if none is */
  uint16_t again;    /* bit i: the agent has requested first + i since the last HEARTBEAT */
  uint16_t unsent;   /* bit i: requested and not yet repeated */
} xrce_stream_reliable_t;

/* Returns whether no sequence number awaits an acknowledgement. */
static inline bool xrce_stream_reliable_is_idle(const xrce_stream_reliable_t * stream)
{
  return stream->count == 0u;
}

/* Returns whether a message without a number may be sent. */
static inline bool xrce_stream_reliable_has_new(const xrce_stream_reliable_t * stream)
{
  return stream->sent < stream->count && stream->sent < (uint32_t)MICROROS_RELIABLE_BEGUN;
}

/* Returns whether the transport has refused data: the stream needs another pump soon. */
static inline bool xrce_stream_reliable_is_blocked(const xrce_stream_reliable_t * stream)
{
  return stream->gap || stream->unsent != 0u || xrce_stream_reliable_has_new(stream);
}

/* Returns how many sequence numbers the stored messages take from `first` on. `is_ready`: there is a session. */
static inline uint32_t xrce_stream_reliable_ahead(const xrce_stream_reliable_t * stream, bool is_ready)
{
  (void)is_ready;
  return stream->count;
}

/* Returns how many acknowledged numbers of stored messages another session repeats: none. */
static inline uint16_t xrce_stream_reliable_again(const xrce_stream_reliable_t * stream)
{
  (void)stream;
  return 0;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_STATE_H */
