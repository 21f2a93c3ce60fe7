/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Waking a task that waits for the transport (xrce_wait) when another one has given the session something to do. What
 * the session calls of this component, in the functions that component.yaml names. Internal.
 */
#ifndef MICROROS_XRCE_TASKS_H
#define MICROROS_XRCE_TASKS_H

#include "microros/port.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What was received may be for a task that waits for the transport. */
static inline void xrce_tasks_wake(xrce_client_t * client)
{
  if (client->seen != client->session.statistics.received) {
    client->seen = client->session.statistics.received;
    if (client->waiting != 0u) {
      port_wake();
    }
  }
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TASKS_H */
