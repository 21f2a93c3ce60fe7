/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

bool port_multicast_open(port_multicast_t * multicast)
{
  int handle = socket(AF_INET, SOCK_DGRAM, 0);
  const int flags = handle >= 0 ? fcntl(handle, F_GETFL) : -1;
  const unsigned int wanted = (unsigned int)flags | (unsigned int)O_NONBLOCK;

  if (handle >= 0 && (flags < 0 || fcntl(handle, F_SETFL, (int)wanted) < 0)) {
    (void)close(handle);
    handle = -1;
  }
  multicast->handle = handle;
  return handle >= 0;
}

void port_multicast_close(port_multicast_t * multicast)
{
  (void)close((int)multicast->handle);
  multicast->handle = -1;
}

/* Sends over the interface with this address; INADDR_ANY: the system selects one. */
static bool multicast_send_over(
  int handle, in_addr_t interface, const struct sockaddr_in * group, const uint8_t * data, size_t size)
{
  struct in_addr over;

  over.s_addr = htonl(interface);
  return setsockopt(handle, IPPROTO_IP, IP_MULTICAST_IF, &over, sizeof(over)) == 0 &&
         sendto(handle, data, size, 0, (const struct sockaddr *)group, sizeof(*group)) == (ssize_t)size;
}

/* An agent that only serves this machine listens on the loopback interface. */
bool port_multicast_send(
  port_multicast_t * multicast, const char * group, uint16_t port, const uint8_t * data, size_t size)
{
  const int handle = (int)multicast->handle;
  struct sockaddr_in address;
  bool outside;
  bool inside;

  (void)memset(&address, 0, sizeof(address));
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  if (inet_pton(AF_INET, group, &address.sin_addr) != 1) {
    return false;
  }
  outside = multicast_send_over(handle, INADDR_ANY, &address, data, size);
  inside = multicast_send_over(handle, INADDR_LOOPBACK, &address, data, size);
  return outside || inside;
}

size_t port_multicast_receive(
  port_multicast_t * multicast, uint8_t * buffer, size_t capacity, uint8_t * sender)
{
  struct sockaddr_in from;
  socklen_t from_size = sizeof(from);
  ssize_t size;

  (void)memset(&from, 0, sizeof(from));
  size = recvfrom((int)multicast->handle, buffer, capacity, 0, (struct sockaddr *)&from, &from_size);
  (void)memcpy(sender, &from.sin_addr, PORT_MULTICAST_ADDRESS);
  return size > 0 ? (size_t)size : 0u;
}
