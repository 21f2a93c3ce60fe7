/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <errno.h>
#include <fcntl.h>
#include <netdb.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum { PORT_DIGITS = 6 };

/* Writes `port` in decimal. */
static void udp_format_port(char * text, uint16_t port)
{
  uint16_t divisor = 10000;
  size_t used = 0;

  while (divisor > 1u && port < divisor) {
    divisor = (uint16_t)(divisor / 10u);
  }
  for (; divisor > 0u; divisor = (uint16_t)(divisor / 10u)) {
    text[used++] = (char)('0' + port / divisor % 10);
  }
  text[used] = '\0';
}

static int udp_connect(const struct addrinfo * address)
{
  const int handle = socket(address->ai_family, address->ai_socktype, address->ai_protocol);
  int flags;

  if (handle < 0) {
    return -1;
  }
  flags = fcntl(handle, F_GETFL);
  if (
    flags < 0 || fcntl(handle, F_SETFL, flags | O_NONBLOCK) < 0 ||
    connect(handle, address->ai_addr, address->ai_addrlen) != 0) {
    (void)close(handle);
    return -1;
  }
  return handle;
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  struct addrinfo hints;
  struct addrinfo * addresses = NULL;
  char service[PORT_DIGITS];
  int handle = -1;

  memset(&hints, 0, sizeof(hints));
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_DGRAM;
  udp_format_port(service, port);
  if (getaddrinfo(host, service, &hints, &addresses) != 0) {
    return false;
  }
  for (const struct addrinfo * at = addresses; at != NULL && handle < 0; at = at->ai_next) {
    handle = udp_connect(at);
  }
  freeaddrinfo(addresses);
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
    sent =
      send(handle, data, size, 0); /* that was the news about an earlier datagram; this one was not sent */
  }
  return sent == (ssize_t)size;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  struct iovec part = {buffer, capacity};
  struct msghdr message;
  ssize_t size;

  memset(&message, 0, sizeof(message));
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  size = recvmsg((int)udp->handle, &message, 0);
  if (size < 0) {
    return 0; /* nothing there, or the news that nobody listens */
  }
  return (message.msg_flags & MSG_TRUNC) != 0 ? -1 : (int32_t)size;
}
