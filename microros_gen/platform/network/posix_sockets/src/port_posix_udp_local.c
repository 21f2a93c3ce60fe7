/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"
#include "microros/port_posix_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

typedef union local_address_t {
  struct sockaddr any;
  struct sockaddr_in v4;
  struct sockaddr_in6 v6;
} local_address_t;

bool port_udp_open_local(port_udp_t * udp, const char * host, uint16_t port, uint16_t local)
{
  const int handle = port_posix_socket_connect(host, port, SOCK_DGRAM, local);

  udp->handle = handle;
  return handle >= 0;
}

uint16_t port_udp_local(const port_udp_t * udp)
{
  local_address_t address;
  socklen_t size = sizeof(address);

  if (getsockname((int)udp->handle, &address.any, &size) != 0) {
    return 0;
  }
  return ntohs(address.any.sa_family == AF_INET ? address.v4.sin_port : address.v6.sin6_port);
}
