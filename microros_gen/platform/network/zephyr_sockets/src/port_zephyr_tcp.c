/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_zephyr_room.h"
#include "microros/port_zephyr_socket.h"

#include <errno.h>
#include <sys/types.h>

bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port)
{
  const int handle = port_zephyr_socket_connect(host, port, SOCK_STREAM, 0);
  const int at_once = 1;

  if (handle >= 0) { /* otherwise a message waits for the acknowledgement of the previous one */
    (void)zsock_setsockopt(handle, IPPROTO_TCP, TCP_NODELAY, &at_once, (socklen_t)sizeof(at_once));
  }
  tcp->handle = handle;
  return handle >= 0;
}

void port_tcp_close(port_tcp_t * tcp)
{
  port_zephyr_room_note((int)tcp->handle, false, false);
  (void)zsock_close((int)tcp->handle);
  tcp->handle = -1;
}

/* Whether the connection only needs time: it is being established, has no room, or nothing arrived. */
static bool tcp_needs_time(int error)
{
  return error == EAGAIN || error == EINTR || error == EINPROGRESS || error == ENOBUFS || error == ENOMEM;
}

/* The kernel reports ENOTCONN while a connection is being established. A failed one also has its own error. */
static bool tcp_is_connecting(int handle)
{
  int error = 0;
  socklen_t size = (socklen_t)sizeof(error);

  return errno == ENOTCONN && zsock_getsockopt(handle, SOL_SOCKET, SO_ERROR, &error, &size) == 0 &&
         (error == 0 || error == EINPROGRESS);
}

int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size)
{
  const ssize_t taken = zsock_send((int)tcp->handle, data, size, 0);

  port_zephyr_room_note(
    (int)tcp->handle, taken != (ssize_t)size, taken < 0 && (errno == ENOBUFS || errno == ENOMEM));
  if (taken >= 0) {
    return (int32_t)taken;
  }
  return tcp_needs_time(errno) || tcp_is_connecting((int)tcp->handle) ? 0 : -1;
}

int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity)
{
  const ssize_t size = zsock_recv((int)tcp->handle, buffer, capacity, 0);

  if (size > 0) {
    return (int32_t)size;
  }
  if (size == 0) {
    return -1; /* the peer has closed it */
  }
  return tcp_needs_time(errno) || tcp_is_connecting((int)tcp->handle) ? 0 : -1;
}
