/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_zephyr_socket.h"

bool port_udp_open_local(port_udp_t * udp, const char * host, uint16_t port, uint16_t local)
{
  const int handle = port_zephyr_socket_connect(host, port, SOCK_DGRAM, local);

  udp->handle = handle;
  return handle >= 0;
}

uint16_t port_udp_local(const port_udp_t * udp)
{
  port_zephyr_address_t address;
  socklen_t size = (socklen_t)sizeof(address);

  if (zsock_getsockname((int)udp->handle, &address.any, &size) != 0) {
    return 0;
  }
  return ntohs(address.any.sa_family == AF_INET ? address.v4.sin_port : address.v6.sin6_port);
}
