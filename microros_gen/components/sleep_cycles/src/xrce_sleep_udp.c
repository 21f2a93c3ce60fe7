/* SPDX-License-Identifier: Apache-2.0 */
/* transport: udp. Address and port identify this client to the agent. */
#include "microros/xrce_sleep.h"

bool xrce_sleep_open(xrce_transport_t * transport, uint16_t local)
{
  return port_udp_open_local(&transport->udp, transport->host, transport->port, local);
}

uint16_t xrce_sleep_local(const xrce_transport_t * transport)
{
  return port_udp_local(&transport->udp);
}
