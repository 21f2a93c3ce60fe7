/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the reliable output stream keeps, with messages that are larger than MICROROS_MTU. Such a message goes in pieces
 * (FRAGMENT), each with a number of its own and each sent again by itself. At most 16 numbers are in use at a time, which is
 * the window of the public agent: what remains of a message is sent while the client is pumped.
 */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_STATE_H
#define MICROROS_XRCE_STREAM_RELIABLE_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All zero is an empty stream. */
typedef struct xrce_stream_reliable_t {
  uint32_t
    due_ms; /* when the next HEARTBEAT is due, while something is unacknowledged; while held: until when */
  uint32_t since_ms; /* when the agent acknowledged something last, or the first message was sent */
  bool held;         /* until due_ms, or until the agent has the writers, nothing is numbered and sent */
  uint8_t count;     /* unacknowledged messages */
  uint8_t sent;      /* numbers from `first` on that are in use */
  bool blocked;      /* the transport did not take the last one: the next pump tries again */
  bool ending;       /* the first of them ends what the agent may have of the session before */
  uint16_t first;    /* oldest number in use; the next one's while none is */
  uint16_t done;     /* pieces of the oldest message that are acknowledged */
  uint16_t again;    /* bit i: the agent asked for first + i since the last HEARTBEAT */
  uint16_t unsent;   /* bit i: and it was not sent again yet */
  uint8_t order[MICROROS_RELIABLE_SLOTS]; /* the slot of the i-th message, exclusive or i */
  uint16_t size[MICROROS_RELIABLE_SLOTS]; /* of the message without what stands before its submessages */
  uint8_t message[MICROROS_RELIABLE_SLOTS][MICROROS_RELIABLE_SLOT_SIZE];
} xrce_stream_reliable_t;

/* Whether no sequence number waits for its acknowledgement. */
static inline bool xrce_stream_reliable_is_idle(const xrce_stream_reliable_t * stream)
{
  return stream->count == 0u && stream->sent == 0u;
}

/* Whether something is to be sent that the transport did not take: it has to be pumped again soon. */
static inline bool xrce_stream_reliable_is_blocked(const xrce_stream_reliable_t * stream)
{
  return stream->blocked;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_STATE_H */
