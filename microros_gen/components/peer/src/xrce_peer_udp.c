/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_peer.h"

#include <string.h>

bool xrce_peer_open(xrce_transport_t * transport, uint8_t index)
{
  const xrce_peer_line_t * line = &xrce_peer_lines[index];

  (void)memset(transport, 0, sizeof(*transport));
  transport->host = line->remote;
  transport->port = line->remote_port;
  return port_udp_open_local(&transport->udp, line->remote, line->remote_port, line->local_port);
}
