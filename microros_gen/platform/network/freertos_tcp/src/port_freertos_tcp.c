/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_freertos_socket.h"

#if !defined(ipconfigUSE_TCP) || ipconfigUSE_TCP != 1
#error "FreeRTOSIPConfig.h: set ipconfigUSE_TCP to 1"
#endif

/* The library ends a connection that cannot be established; its socket then has no room. */
bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port)
{
  struct freertos_sockaddr address;
  Socket_t socket = FREERTOS_INVALID_SOCKET;
  BaseType_t result = 0;

  if (port_freertos_address(&address, host, port)) {
    socket = port_freertos_socket(FREERTOS_SOCK_STREAM, FREERTOS_IPPROTO_TCP, 0);
  }
  if (socket != FREERTOS_INVALID_SOCKET) {
    result = FreeRTOS_connect(socket, &address, (socklen_t)sizeof(address));
    if (result != 0 && result != -pdFREERTOS_ERRNO_EWOULDBLOCK) {
      (void)FreeRTOS_closesocket(socket);
      socket = FREERTOS_INVALID_SOCKET;
    }
  }
  tcp->handle = port_freertos_handle_of(socket);
  return tcp->handle != 0;
}

void port_tcp_close(port_tcp_t * tcp)
{
  if (tcp->handle != 0) {
    (void)FreeRTOS_closesocket(port_freertos_socket_of(tcp->handle));
  }
  tcp->handle = 0;
}

/* Without room the connection is being established, or its output waits; less than 0: it is closed. */
int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size)
{
  const Socket_t socket = port_freertos_socket_of(tcp->handle);
  const BaseType_t room = FreeRTOS_maywrite(socket);
  BaseType_t sent;

  if (room <= 0) {
    return room < 0 ? -1 : 0;
  }
  sent = FreeRTOS_send(socket, data, size < (size_t)room ? size : (size_t)room, 0);
  if (sent >= 0) {
    return (int32_t)sent;
  }
  return sent == -pdFREERTOS_ERRNO_ENOSPC ? 0 : -1;
}

int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity)
{
  const BaseType_t size = FreeRTOS_recv(port_freertos_socket_of(tcp->handle), buffer, capacity, 0);

  return size >= 0 ? (int32_t)size : size == -pdFREERTOS_ERRNO_EWOULDBLOCK ? 0 : -1;
}
