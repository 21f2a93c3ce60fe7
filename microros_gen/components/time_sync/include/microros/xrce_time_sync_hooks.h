/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_TIME_SYNC_HOOKS_H
#define MICROROS_XRCE_TIME_SYNC_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* After a sleep of the device the offset is invalid: the clock has stopped for an unknown time. */
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
