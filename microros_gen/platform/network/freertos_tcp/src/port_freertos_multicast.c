/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_freertos_socket.h"

#include <string.h>

bool port_multicast_open(port_multicast_t * multicast)
{
  multicast->handle =
    port_freertos_handle_of(port_freertos_socket(FREERTOS_SOCK_DGRAM, FREERTOS_IPPROTO_UDP, 0));
  return multicast->handle != 0;
}

void port_multicast_close(port_multicast_t * multicast)
{
  if (multicast->handle != 0) {
    (void)FreeRTOS_closesocket(port_freertos_socket_of(multicast->handle));
  }
  multicast->handle = 0;
}

bool port_multicast_send(
  port_multicast_t * multicast, const char * group, uint16_t port, const uint8_t * data, size_t size)
{
  struct freertos_sockaddr address;

  return size <= (size_t)INT32_MAX && port_freertos_address(&address, group, port) &&
         FreeRTOS_sendto(
           port_freertos_socket_of(multicast->handle), data, size, 0, &address,
           (socklen_t)sizeof(address)) == (int32_t)size;
}

size_t port_multicast_receive(
  port_multicast_t * multicast, uint8_t * buffer, size_t capacity, uint8_t * sender)
{
  struct freertos_sockaddr from;
  const int32_t size =
    port_freertos_receive(port_freertos_socket_of(multicast->handle), &from, buffer, capacity);

  if (size == 0) {
    return 0;
  }
  (void)memcpy(sender, &from.sin_address.ulIP_IPv4, PORT_MULTICAST_ADDRESS); /* as on the wire */
  return size > 0 ? (size_t)size : capacity;
}
