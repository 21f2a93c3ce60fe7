/* SPDX-License-Identifier: Apache-2.0 */
/* A sample of a link may be for the slot in the input buffer. Internal. */
#ifndef MICROROS_XRCE_PEER_SETTLE_H
#define MICROROS_XRCE_PEER_SETTLE_H

#include "microros/xrce_client.h"
#include "microros/xrce_read.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called after each message of a link. */
static inline void xrce_peer_settle(xrce_client_t * client)
{
  xrce_read_settle(client);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_SETTLE_H */
