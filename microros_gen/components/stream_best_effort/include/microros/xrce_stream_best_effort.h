/* SPDX-License-Identifier: Apache-2.0 */
/* The best-effort output stream: one message, encoded in place and sent at once; several that wait with a queue. */
#ifndef MICROROS_XRCE_STREAM_BEST_EFFORT_H
#define MICROROS_XRCE_STREAM_BEST_EFFORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new session: its numbers begin with 0. Only without a queue. */
void xrce_stream_best_effort_reset(void);

/* Returns room for MICROROS_BEST_EFFORT_SIZE - XRCE_MESSAGE_HEADER bytes of submessages. NULL: the queue
 * is full; never without one. */
uint8_t * xrce_stream_best_effort_reserve(void);

/* Sends `size` bytes of submessages, or lets them wait in the queue. Returns false if the transport refused them, and they
 * are dropped; never with a queue. */
bool xrce_stream_best_effort_commit(xrce_session_t * session, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_BEST_EFFORT_H */
