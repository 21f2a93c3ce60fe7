/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"
#include "microros/port_posix_room.h"
#include "microros/port_posix_socket.h"

#include <errno.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port)
{
  const int handle = port_posix_socket_connect(host, port, SOCK_STREAM, 0);
  const int at_once = 1;

  if (handle >= 0) { /* otherwise a message waits for the acknowledgement of the previous one */
    (void)setsockopt(handle, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof(at_once));
  }
  tcp->handle = handle;
  return handle >= 0;
}

void port_tcp_close(port_tcp_t * tcp)
{
  port_posix_room_note((int)tcp->handle, false);
  (void)close((int)tcp->handle);
  tcp->handle = -1;
}

/* Whether the connection only needs time: it is being established, has no room, or nothing arrived. */
static bool tcp_needs_time(int error)
{
  return error == EAGAIN || error == EINTR || error == EINPROGRESS;
}

/* Some systems report ENOTCONN while a connection is being established. A failed one also has its own error. */
static bool tcp_is_connecting(int handle)
{
  int error = 0;
  socklen_t size = sizeof(error);

  return errno == ENOTCONN && getsockopt(handle, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
}

int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size)
{
  const ssize_t taken = send((int)tcp->handle, data, size, MSG_NOSIGNAL);

  port_posix_room_note((int)tcp->handle, taken != (ssize_t)size);
  if (taken >= 0) {
    return (int32_t)taken;
  }
  return tcp_needs_time(errno) || tcp_is_connecting((int)tcp->handle) ? 0 : -1;
}

int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity)
{
  const ssize_t size = recv((int)tcp->handle, buffer, capacity, 0);

  if (size > 0) {
    return (int32_t)size;
  }
  if (size == 0) {
    return -1; /* the peer has closed it */
  }
  return tcp_needs_time(errno) || tcp_is_connecting((int)tcp->handle) ? 0 : -1;
}
