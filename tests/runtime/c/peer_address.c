/* SPDX-License-Identifier: Apache-2.0 */
/* The handle of a link is an address in the upper half of the memory, as an IP stack may have it: its device is there. */
#include "microros/xrce_client.h"
#include "microros/xrce_peer.h"
#include "microros/xrce_peer_find.h"

enum { ADDRESS = -4096 };

xrce_peer_port_t xrce_peer_ports[MICROROS_PEERS];
static xrce_client_t client;

int main(void)
{
  xrce_peer_ports[0].is_open = true;
  xrce_peer_ports[0].transport.udp.handle = ADDRESS;
  return xrce_peer_find(&client, 0, 0) ? 1 : 0;
}
