/* SPDX-License-Identifier: Apache-2.0 */
/*
 * State of the reliable output stream if messages can be larger than MICROROS_MTU. Such a message is sent
 * as fragments (FRAGMENT), each with a separate number and repeated individually. At most 16 numbers are
 * in use, the window of the public agent: the rest of a message is sent while the client is pumped.
 */
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
  uint8_t count;     /* unacknowledged messages */
  uint8_t sent;      /* numbers from `first` on that are in use */
  bool blocked;      /* the transport refused the last one: the next pump tries again */
  bool ending;       /* the first number terminates a partial message of the previous session */
  uint16_t first;    /* oldest number in use; the next one to assign if none is */
  uint16_t done;     /* acknowledged fragments of the oldest message */
  uint16_t again;    /* bit i: the agent has requested first + i since the last HEARTBEAT */
  uint16_t unsent;   /* bit i: requested and not yet repeated */
} xrce_stream_reliable_t;

/* Returns whether no sequence number awaits an acknowledgement. */
static inline bool xrce_stream_reliable_is_idle(const xrce_stream_reliable_t * stream)
{
  return stream->count == 0u && stream->sent == 0u;
}

/* Returns whether the transport has refused data: the stream needs another pump soon. */
static inline bool xrce_stream_reliable_is_blocked(const xrce_stream_reliable_t * stream)
{
  return stream->blocked;
}

/* Returns how many sequence numbers the stored messages take from `first` on, with the one that ends a partial message.
 * `is_ready`: there is a session; the next one repeats every fragment. */
uint32_t xrce_stream_reliable_ahead(const xrce_stream_reliable_t * stream, bool is_ready);

/* Returns by how many numbers that is more in another session. */
static inline uint16_t xrce_stream_reliable_again(const xrce_stream_reliable_t * stream)
{
  return stream->ending ? stream->done : (uint16_t)(stream->done + 1u);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_STATE_H */
