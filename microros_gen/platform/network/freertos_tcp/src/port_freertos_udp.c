/* SPDX-License-Identifier: Apache-2.0 */
/* The library's UDP sockets know no peer: each has its peer here, and what others send is dropped. */
#include "microros/port.h"
#include "microros/port_freertos_socket.h"
#include "microros_config.h"

#include "microros/links.h"

/* The agent's, one to another agent that is pinged, and those of links with other boards. */
enum { PEERS = 2 + (int)MICROROS_LINKS };

typedef struct udp_peer_t {
  Socket_t socket; /* NULL: not open */
  struct freertos_sockaddr address;
} udp_peer_t;

static udp_peer_t peers[PEERS];

static udp_peer_t * peer_of(Socket_t socket)
{
  for (size_t i = 0; i < (size_t)PEERS; ++i) {
    if (peers[i].socket == socket) {
      return &peers[i];
    }
  }
  return NULL;
}

intptr_t port_freertos_udp(const char * host, uint16_t port, uint16_t local)
{
  udp_peer_t * place = peer_of(NULL);
  Socket_t socket = FREERTOS_INVALID_SOCKET;

  if (place != NULL && port_freertos_address(&place->address, host, port)) {
    socket = port_freertos_socket(FREERTOS_SOCK_DGRAM, FREERTOS_IPPROTO_UDP, local);
    place->socket = port_freertos_socket_of(port_freertos_handle_of(socket));
  }
  return port_freertos_handle_of(socket);
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  udp->handle = port_freertos_udp(host, port, 0);
  return udp->handle != 0;
}

void port_udp_close(port_udp_t * udp)
{
  udp_peer_t * peer = udp->handle != 0 ? peer_of(port_freertos_socket_of(udp->handle)) : NULL;

  if (peer != NULL) {
    (void)FreeRTOS_closesocket(peer->socket);
    peer->socket = NULL;
  }
  udp->handle = 0;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  const udp_peer_t * peer = peer_of(port_freertos_socket_of(udp->handle));

  return peer != NULL && size <= (size_t)INT32_MAX &&
         FreeRTOS_sendto(peer->socket, data, size, 0, &peer->address, (socklen_t)sizeof(peer->address)) ==
           (int32_t)size;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  const udp_peer_t * peer = peer_of(port_freertos_socket_of(udp->handle));
  struct freertos_sockaddr from;
  int32_t size;

  if (peer == NULL) {
    return 0;
  }
  size = port_freertos_receive(peer->socket, &from, buffer, capacity);
  if (
    size != 0 && (from.sin_port != peer->address.sin_port ||
                  from.sin_address.ulIP_IPv4 != peer->address.sin_address.ulIP_IPv4)) {
    size = 0;
  }
  return size;
}
