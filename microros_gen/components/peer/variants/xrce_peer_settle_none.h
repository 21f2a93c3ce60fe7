/* SPDX-License-Identifier: Apache-2.0 */
/* No sample waits in the input buffer. Internal. */
#ifndef MICROROS_XRCE_PEER_SETTLE_H
#define MICROROS_XRCE_PEER_SETTLE_H

#include "microros/xrce_client.h"

/* Called after each message of a link. */
static inline void xrce_peer_settle(xrce_client_t * client)
{
  (void)client;
}

#endif /* MICROROS_XRCE_PEER_SETTLE_H */
