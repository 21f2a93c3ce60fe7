/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wakes a task that waits for the transport (xrce_wait) after another task gave the session work. Hooks
 * called by the session, as declared in component.yaml. Internal.
 */
#ifndef MICROROS_XRCE_TASKS_H
#define MICROROS_XRCE_TASKS_H

#include "microros/wake.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Received data may be for a task that waits for the transport, or is about to. */
static inline void xrce_tasks_wake(xrce_client_t * client)
{
  if (client->seen != client->session.statistics.received) {
    client->seen = client->session.statistics.received;
    microros_note();
    if (client->waiting != 0u) {
      port_wake();
    }
  }
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TASKS_H */
