/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_zephyr_socket.h"

#include <sys/types.h>

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  const int handle = port_zephyr_socket_connect(host, port, SOCK_DGRAM, 0);

  udp->handle = handle;
  return handle >= 0;
}

void port_udp_close(port_udp_t * udp)
{
  (void)zsock_close((int)udp->handle);
  udp->handle = -1;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  return zsock_send((int)udp->handle, data, size, 0) == (ssize_t)size;
}

/* With the flag, the kernel returns the length of the datagram, not of the part that it has copied. */
int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  const ssize_t size = zsock_recv((int)udp->handle, buffer, capacity, ZSOCK_MSG_TRUNC);

  if (size <= 0) {
    return 0; /* nothing arrived, or an ICMP error: nobody listens */
  }
  return (size_t)size <= capacity ? (int32_t)size : -1;
}
