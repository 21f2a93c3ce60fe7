/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_TIME_SOURCE_HOOKS_H
#define MICROROS_XRCE_TIME_SOURCE_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A new session asks at once: how long the agent was away is not known. */
static inline void xrce_time_source_connected(xrce_time_source_t * source, uint32_t now)
{
  source->due_ms = now;
  source->since_ms = now;
}

/* After a sleep the time is not known: the clock has stopped for an unknown time, so it is asked for at once, and a reply from
 * before says nothing. The drift is kept. */
static inline void xrce_time_source_wake(xrce_client_t * client, uint32_t now)
{
  xrce_time_source_t * source = &client->time_source;

  source->due_ms = now;
  source->since_ms = now;
  source->replies = client->time_sync.replies;
  source->asks = false;
  source->filter.is_set = false;
  source->filter.variance.offset = 0;
  source->filter.outliers = 0;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TIME_SOURCE_HOOKS_H */
