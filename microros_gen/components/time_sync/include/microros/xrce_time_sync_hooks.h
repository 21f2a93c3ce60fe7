/* SPDX-License-Identifier: Apache-2.0 */
/* What the session calls of this component, in the functions that component.yaml names. Internal. */
#ifndef MICROROS_XRCE_TIME_SYNC_HOOKS_H
#define MICROROS_XRCE_TIME_SYNC_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The device has slept: the clock has stood still, nobody knows how long. */
static inline void xrce_time_sync_wake(xrce_client_t * client)
{
  client->time_sync.callers = 0;
  client->time_sync.synchronized = false;
  client->time_sync.offset_ns = 0;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TIME_SYNC_HOOKS_H */
