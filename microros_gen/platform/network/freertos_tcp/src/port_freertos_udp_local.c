/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_freertos_socket.h"

bool port_udp_open_local(port_udp_t * udp, const char * host, uint16_t port, uint16_t local)
{
  udp->handle = port_freertos_udp(host, port, local);
  return udp->handle != 0;
}

uint16_t port_udp_local(const port_udp_t * udp)
{
  struct freertos_sockaddr address;

  address.sin_port = 0;
  (void)FreeRTOS_GetLocalAddress(port_freertos_socket_of(udp->handle), &address);
  return FreeRTOS_ntohs(address.sin_port);
}
