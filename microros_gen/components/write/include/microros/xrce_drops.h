/* SPDX-License-Identifier: Apache-2.0 */
/* Dropped messages, counted for the session. Internal. */
#ifndef MICROROS_XRCE_DROPS_H
#define MICROROS_XRCE_DROPS_H

#include <stdint.h>

#include "microros/xrce_client.h"

/* Counts one message of the endpoint `index`; per publisher with the component publish_statistics. */
static inline void xrce_drops_add(xrce_client_t * client, uint16_t index)
{
  ++client->session.statistics.dropped;
  (void)index;
}

/* Called when the publisher `index` has a new owner. */
static inline void xrce_drops_clear(xrce_client_t * client, uint16_t index)
{
  (void)client;
  (void)index;
}

#endif /* MICROROS_XRCE_DROPS_H */
