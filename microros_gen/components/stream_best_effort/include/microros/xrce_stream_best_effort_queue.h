/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks of the best-effort output stream with a queue, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_STREAM_BEST_EFFORT_QUEUE_H
#define MICROROS_XRCE_STREAM_BEST_EFFORT_QUEUE_H

#include <stdint.h>

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new session, in which the agent may not have the writers yet: drops what waits, and counts it. */
void xrce_stream_best_effort_restart(xrce_session_t * session);

/* Sends as much as the transport accepts. */
void xrce_stream_best_effort_step(xrce_session_t * session);

/* Returns the time until there is something to send, at most `left`. */
static inline uint32_t xrce_stream_best_effort_left(uint32_t left, uint32_t now)
{
  return xrce_output_queue_is_empty() ? left : xrce_turn_blocked(left, now);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_BEST_EFFORT_QUEUE_H */
