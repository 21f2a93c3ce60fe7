/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_freertos_socket.h"

#include "microros/port.h"

#include <string.h>

typedef void (*wake_t)(Socket_t socket);

/* The library takes a function as a pointer to void. */
typedef char port_freertos_functions_are_as_wide[sizeof(wake_t) == sizeof(void *) ? 1 : -1];

/* In the library's task. */
static void socket_event(Socket_t socket)
{
  (void)socket;
  port_wake();
}

bool port_freertos_address(struct freertos_sockaddr * address, const char * host, uint16_t port)
{
  uint32_t ip = 0;

  if (FreeRTOS_inet_pton(FREERTOS_AF_INET, host, &ip) != pdPASS) {
    return false;
  }
  (void)memset(address, 0, sizeof(*address));
  address->sin_len = (uint8_t)sizeof(*address);
  address->sin_family = FREERTOS_AF_INET;
  address->sin_port = FreeRTOS_htons(port);
  address->sin_address.ulIP_IPv4 = ip;
  return true;
}

static bool socket_set(Socket_t socket)
{
  const TickType_t no_wait = 0;
  const wake_t event = socket_event;
  void * wake = NULL;

  (void)memcpy(&wake, &event, sizeof(wake));
  return FreeRTOS_setsockopt(socket, 0, FREERTOS_SO_RCVTIMEO, &no_wait, sizeof(no_wait)) == 0 &&
         FreeRTOS_setsockopt(socket, 0, FREERTOS_SO_SNDTIMEO, &no_wait, sizeof(no_wait)) == 0 &&
         FreeRTOS_setsockopt(socket, 0, FREERTOS_SO_WAKEUP_CALLBACK, wake, sizeof(wake)) == 0;
}

Socket_t port_freertos_socket(BaseType_t type, BaseType_t protocol, uint16_t local)
{
  struct freertos_sockaddr address;
  Socket_t socket = FREERTOS_INVALID_SOCKET;

  if (FreeRTOS_IsNetworkUp() != pdFALSE) {
    socket = FreeRTOS_socket(FREERTOS_AF_INET, type, protocol);
  }
  if (socket != FREERTOS_INVALID_SOCKET) {
    (void)memset(&address, 0, sizeof(address));
    address.sin_len = (uint8_t)sizeof(address);
    address.sin_family = FREERTOS_AF_INET;
    address.sin_port = FreeRTOS_htons(local);
    if (!socket_set(socket) || FreeRTOS_bind(socket, &address, (socklen_t)sizeof(address)) != 0) {
      (void)FreeRTOS_closesocket(socket);
      socket = FREERTOS_INVALID_SOCKET;
    }
  }
  return socket;
}

/* A datagram that is copied by the library loses its end silently: here it stays in the library's buffer until its length
 * is known. */
int32_t port_freertos_receive(Socket_t socket, struct freertos_sockaddr * from, uint8_t * buffer, size_t capacity)
{
  void * bytes = NULL;
  socklen_t from_size = (socklen_t)sizeof(*from);
  const int32_t size = FreeRTOS_recvfrom(socket, &bytes, 0, FREERTOS_ZERO_COPY, from, &from_size);
  size_t taken;

  if (size < 0 || bytes == NULL) {
    return 0;
  }
  taken = (size_t)size < capacity ? (size_t)size : capacity;
  (void)memcpy(buffer, bytes, taken);
  FreeRTOS_ReleaseUDPPayloadBuffer(bytes);
  return taken == (size_t)size ? size : -1;
}

Socket_t port_freertos_socket_of(intptr_t handle)
{
  return (Socket_t)handle;
}

intptr_t port_freertos_handle_of(Socket_t socket)
{
  return socket == FREERTOS_INVALID_SOCKET ? 0 : (intptr_t)socket;
}
