/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_zephyr_socket.h"

#include <string.h>
#include <sys/types.h>

bool port_multicast_open(port_multicast_t * multicast)
{
  const int handle = zsock_socket(AF_INET, SOCK_DGRAM, IPPROTO_UDP);

  multicast->handle = handle;
  return handle >= 0;
}

void port_multicast_close(port_multicast_t * multicast)
{
  (void)zsock_close((int)multicast->handle);
  multicast->handle = -1;
}

bool port_multicast_send(
  port_multicast_t * multicast, const char * group, uint16_t port, const uint8_t * data, size_t size)
{
  struct sockaddr_in address;

  (void)memset(&address, 0, sizeof(address));
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  return zsock_inet_pton(AF_INET, group, &address.sin_addr) == 1 &&
         zsock_sendto(
           (int)multicast->handle, data, size, ZSOCK_MSG_DONTWAIT, (const struct sockaddr *)&address,
           (socklen_t)sizeof(address)) == (ssize_t)size;
}

size_t port_multicast_receive(
  port_multicast_t * multicast, uint8_t * buffer, size_t capacity, uint8_t * sender)
{
  struct sockaddr_in from;
  socklen_t from_size = (socklen_t)sizeof(from);
  ssize_t size;

  (void)memset(&from, 0, sizeof(from));
  size = zsock_recvfrom(
    (int)multicast->handle, buffer, capacity, ZSOCK_MSG_DONTWAIT, (struct sockaddr *)&from, &from_size);
  (void)memcpy(sender, &from.sin_addr, PORT_MULTICAST_ADDRESS);
  return size > 0 ? (size_t)size : 0u;
}
