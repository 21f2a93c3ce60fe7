/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_posix_socket.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

typedef union address_t {
  struct sockaddr any;
  struct sockaddr_in v4;
  struct sockaddr_in6 v6;
} address_t;

/* Returns the size of the address; 0: the text is not an address. */
static socklen_t socket_parse(address_t * address, const char * host, uint16_t port)
{
  (void)memset(address, 0, sizeof(*address));
  if (inet_pton(AF_INET, host, &address->v4.sin_addr) == 1) {
    address->v4.sin_family = AF_INET;
    address->v4.sin_port = htons(port);
    return sizeof(address->v4);
  }
  if (inet_pton(AF_INET6, host, &address->v6.sin6_addr) == 1) {
    address->v6.sin6_family = AF_INET6;
    address->v6.sin6_port = htons(port);
    return sizeof(address->v6);
  }
  return 0;
}

static bool socket_begin(int handle, const address_t * address, socklen_t size)
{
  const int flags = fcntl(handle, F_GETFL);
  const unsigned int wanted = (unsigned int)flags | (unsigned int)O_NONBLOCK;

  return flags >= 0 && fcntl(handle, F_SETFL, (int)wanted) >= 0 &&
         (connect(handle, &address->any, size) == 0 || errno == EINPROGRESS);
}

/* Binds the local port; 0: the system selects one at the connect. */
static bool socket_bind(int handle, const address_t * peer, socklen_t size, uint16_t local)
{
  address_t address;

  (void)memset(&address, 0, sizeof(address));
  address.any.sa_family = peer->any.sa_family;
  if (peer->any.sa_family == AF_INET) {
    address.v4.sin_port = htons(local);
  } else {
    address.v6.sin6_port = htons(local);
  }
  return local == 0u || bind(handle, &address.any, size) == 0;
}

int port_posix_socket_connect(const char * host, uint16_t port, int kind, uint16_t local)
{
  address_t address;
  const socklen_t size = socket_parse(&address, host, port);
  int handle;

  if (size == 0u) {
    return -1;
  }
  handle = socket(address.any.sa_family, kind, 0);
  if (handle >= 0 && !(socket_bind(handle, &address, size, local) && socket_begin(handle, &address, size))) {
    (void)close(handle);
    handle = -1;
  }
  return handle;
}
