/* SPDX-License-Identifier: Apache-2.0 */
/* What the reliable output stream keeps, where every message fits MICROROS_MTU. */
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
  uint8_t head;      /* slot of the oldest message */
  uint16_t first;    /* its sequence number; while held: the next one's */
  uint16_t unsent;   /* bit i: first + i is to be sent */
  uint16_t size[MICROROS_RELIABLE_SLOTS]; /* of the message without what stands before its submessages */
  uint8_t message[MICROROS_RELIABLE_SLOTS][MICROROS_RELIABLE_SLOT_SIZE];
} xrce_stream_reliable_t;

/* Whether no sequence number waits for its acknowledgement. */
static inline bool xrce_stream_reliable_is_idle(const xrce_stream_reliable_t * stream)
{
  return stream->count == 0u;
}

/* Whether something is to be sent that the transport did not take: it has to be pumped again soon. */
static inline bool xrce_stream_reliable_is_blocked(const xrce_stream_reliable_t * stream)
{
  return stream->unsent != 0u;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_STATE_H */
