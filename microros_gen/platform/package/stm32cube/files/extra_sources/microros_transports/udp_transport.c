/* SPDX-License-Identifier: Apache-2.0 */
/* UDP by the sockets of lwIP. The network is up (MX_LWIP_Init) before rclc_support_init. */
#include "cubemx_transport.h"

#if !defined(MICROROS_TRANSPORT) || MICROROS_TRANSPORT == MICROROS_TRANSPORT_UDP

#include "lwip/opt.h"

#include "lwip/inet.h"
#include "lwip/sockets.h"

#include <string.h>

#if !LWIP_SO_RCVTIMEO
#error "enable LWIP_SO_RCVTIMEO in STM32CubeMX (LwIP, Key Options)"
#endif

/* The port of the agent. */
#ifndef UDP_PORT
#define UDP_PORT 8888
#endif

static int socket_or_none = -1;

/* Takes the datagrams of the agent alone. Its address is transport->args, "192.168.1.10". */
bool cubemx_transport_open(struct uxrCustomTransport * transport)
{
  struct sockaddr_in agent;

  (void)memset(&agent, 0, sizeof(agent));
  agent.sin_family = AF_INET;
  agent.sin_port = lwip_htons(UDP_PORT);
  if (transport->args == NULL || inet_aton((const char *)transport->args, &agent.sin_addr) == 0) {
    return false;
  }
  (void)cubemx_transport_close(transport);
  socket_or_none = lwip_socket(AF_INET, SOCK_DGRAM, 0);
  if (socket_or_none < 0) {
    return false;
  }
  if (lwip_connect(socket_or_none, (const struct sockaddr *)&agent, (socklen_t)sizeof(agent)) != 0) {
    (void)cubemx_transport_close(transport);
    return false;
  }
  return true;
}

bool cubemx_transport_close(struct uxrCustomTransport * transport)
{
  (void)transport;
  if (socket_or_none >= 0) {
    (void)lwip_close(socket_or_none);
    socket_or_none = -1;
  }
  return true;
}

/* A datagram without room in the network's memory is dropped there. */
size_t cubemx_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const ssize_t sent = lwip_send(socket_or_none, buf, len, 0);

  (void)transport;
  if (sent < 0) {
    *err = 1;
    return 0;
  }
  return (size_t)sent;
}

size_t cubemx_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  const int wait_ms = timeout > 0 ? timeout : 0;
  struct timeval wait;
  ssize_t size;

  (void)transport;
  (void)err;
  wait.tv_sec = wait_ms / 1000;
  wait.tv_usec = (wait_ms % 1000) * 1000;
  (void)lwip_setsockopt(socket_or_none, SOL_SOCKET, SO_RCVTIMEO, &wait, (socklen_t)sizeof(wait));
  size = lwip_recv(socket_or_none, buf, len, wait_ms == 0 ? MSG_DONTWAIT : 0);
  return size > 0 ? (size_t)size : 0u;
}

#endif
