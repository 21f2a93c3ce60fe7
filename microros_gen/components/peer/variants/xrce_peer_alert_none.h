/* SPDX-License-Identifier: Apache-2.0 */
/* No other task waits. Internal. */
#ifndef MICROROS_XRCE_PEER_ALERT_H
#define MICROROS_XRCE_PEER_ALERT_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called when a HEARTBEAT, or a message that is not sent yet, becomes due. */
static inline void xrce_peer_alert(const xrce_client_t * client)
{
  (void)client;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_ALERT_H */
