/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_zephyr_socket.h"

#include <errno.h>
#include <stdbool.h>
#include <string.h>

/* Returns the size of the address; 0: the text is not an address. */
static socklen_t socket_parse(port_zephyr_address_t * address, const char * host, uint16_t port)
{
  (void)memset(address, 0, sizeof(*address));
  if (zsock_inet_pton(AF_INET, host, &address->v4.sin_addr) == 1) {
    address->v4.sin_family = AF_INET;
    address->v4.sin_port = htons(port);
    return (socklen_t)sizeof(address->v4);
  }
  if (zsock_inet_pton(AF_INET6, host, &address->v6.sin6_addr) == 1) {
    address->v6.sin6_family = AF_INET6;
    address->v6.sin6_port = htons(port);
    return (socklen_t)sizeof(address->v6);
  }
  return 0;
}

static bool socket_begin(int handle, const port_zephyr_address_t * address, socklen_t size)
{
  const int flags = zsock_fcntl(handle, ZVFS_F_GETFL, 0);

  return flags >= 0 && zsock_fcntl(handle, ZVFS_F_SETFL, flags | ZVFS_O_NONBLOCK) >= 0 &&
         (zsock_connect(handle, &address->any, size) == 0 || errno == EINPROGRESS);
}

/* Binds the local port; 0: the kernel selects one at the connect. */
static bool socket_bind(int handle, const port_zephyr_address_t * peer, socklen_t size, uint16_t local)
{
  port_zephyr_address_t address;

  (void)memset(&address, 0, sizeof(address));
  address.any.sa_family = peer->any.sa_family;
  if (peer->any.sa_family == AF_INET) {
    address.v4.sin_port = htons(local);
  } else {
    address.v6.sin6_port = htons(local);
  }
  return local == 0u || zsock_bind(handle, &address.any, size) == 0;
}

int port_zephyr_socket_connect(const char * host, uint16_t port, int kind, uint16_t local)
{
  port_zephyr_address_t address;
  const socklen_t size = socket_parse(&address, host, port);
  int handle;

  if (size == 0u) {
    return -1;
  }
  handle = zsock_socket(address.any.sa_family, kind, kind == SOCK_STREAM ? IPPROTO_TCP : IPPROTO_UDP);
  if (handle >= 0 && !(socket_bind(handle, &address, size, local) && socket_begin(handle, &address, size))) {
    (void)zsock_close(handle);
    handle = -1;
  }
  return handle;
}
