/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_peer.h"

#include <string.h>

bool xrce_peer_open(xrce_transport_t * transport, uint8_t index)
{
  (void)memset(transport, 0, sizeof(*transport));
  transport->device = xrce_peer_lines[index].remote;
  return xrce_transport_open(transport);
}
