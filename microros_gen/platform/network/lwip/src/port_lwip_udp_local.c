/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_lwip.h"

bool port_udp_open_local(port_udp_t * udp, const char * host, uint16_t port, uint16_t local)
{
  struct netconn * connection = port_lwip_udp(host, port, local);

  udp->handle = (intptr_t)connection;
  return connection != NULL;
}

uint16_t port_udp_local(const port_udp_t * udp)
{
  ip_addr_t address;
  u16_t port = 0;

  return netconn_addr((struct netconn *)udp->handle, &address, &port) == ERR_OK ? port : 0u;
}
