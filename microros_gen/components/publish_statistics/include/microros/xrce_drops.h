/* SPDX-License-Identifier: Apache-2.0 */
/* Dropped messages, counted for the session and for each publisher. Internal. */
#ifndef MICROROS_XRCE_DROPS_H
#define MICROROS_XRCE_DROPS_H

#include <stdint.h>

#include "microros/xrce_client.h"
#include "microros/xrce_place.h"

/* Counts one message of the endpoint `index`. */
static inline void xrce_drops_add(xrce_client_t * client, uint16_t index)
{
  ++client->session.statistics.dropped;
  if (index < MICROROS_PUBLISHERS_MAX) {
    ++client->dropped[index];
  }
}

/* Called when the publisher `index` has a new owner. */
static inline void xrce_drops_clear(xrce_client_t * client, uint16_t index)
{
  if (!xrce_place_is_kept(client, (uint16_t)(MICROROS_NODES_MAX + index))) {
    client->dropped[index] = 0;
  }
}

#endif /* MICROROS_XRCE_DROPS_H */
