/* SPDX-License-Identifier: Apache-2.0 */
/* Serial links: the port itself looks for a device that has disappeared. Internal. */
#ifndef MICROROS_XRCE_PEER_FIND_H
#define MICROROS_XRCE_PEER_FIND_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_peer.h"

/* Returns whether the device of a link is gone. The only line of a board never has this handle. */
static inline bool xrce_peer_find(const xrce_client_t * client, uint8_t index, uint32_t now)
{
  (void)client;
  (void)now;
  return xrce_transport_handle(&xrce_peer_ports[index].transport) < -1;
}

#endif /* MICROROS_XRCE_PEER_FIND_H */
