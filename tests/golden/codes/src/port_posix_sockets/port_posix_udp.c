/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"
#include "microros/port_posix_socket.h"

#include <errno.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  const int handle = port_posix_socket_connect(host, port, SOCK_DGRAM, 0);

  udp->handle = handle;
  return handle >= 0;
}

void port_udp_close(port_udp_t * udp)
{
  (void)close((int)udp->handle);
  udp->handle = -1;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  const int handle = (int)udp->handle;
  ssize_t sent = send(handle, data, size, 0);

  if (sent < 0 && errno == ECONNREFUSED) {
    sent = send(handle, data, size, 0); /* the error belonged to an earlier datagram: this one was not sent */
  }
  return sent == (ssize_t)size;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  struct iovec part = {buffer, capacity};
  struct msghdr message;
  ssize_t size;

  (void)memset(&message, 0, sizeof(message));
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  size = recvmsg((int)udp->handle, &message, 0);
  if (size < 0) {
    return 0; /* nothing arrived, or an ICMP error: nobody listens */
  }
  return (message.msg_flags & MSG_TRUNC) != 0 ? -1 : (int32_t)size;
}
