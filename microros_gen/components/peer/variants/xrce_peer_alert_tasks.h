/* SPDX-License-Identifier: Apache-2.0 */
/* A task that waits learns that a link has work to do. Internal. */
#ifndef MICROROS_XRCE_PEER_ALERT_H
#define MICROROS_XRCE_PEER_ALERT_H

#include "microros/port.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called when a HEARTBEAT, or a message that is not sent yet, becomes due. */
static inline void xrce_peer_alert(const xrce_client_t * client)
{
  if (client->waiting != 0u) {
    port_wake();
  }
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_ALERT_H */
