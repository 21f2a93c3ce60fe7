/* SPDX-License-Identifier: Apache-2.0 */
#include "microros_transports.h"

#include <errno.h>
#include <string.h>
#include <sys/types.h>

#if !defined(CONFIG_NET_UDP) || !defined(CONFIG_NET_SOCKETS)
#error "prj.conf: set CONFIG_NETWORKING=y, CONFIG_NET_UDP=y and CONFIG_NET_SOCKETS=y"
#endif

zephyr_transport_params_t default_params = {
  .poll_fd = {.fd = -1}, .ip = CONFIG_MICROROS_AGENT_IP, .port = CONFIG_MICROROS_AGENT_PORT};

static zephyr_transport_params_t * params_of(const struct uxrCustomTransport * transport)
{
  return (zephyr_transport_params_t *)transport->args;
}

/* Returns 0 for a text that is no port. */
static uint16_t port_parse(const char * text)
{
  uint32_t port = 0;
  size_t i = 0;

  while (text[i] >= '0' && text[i] <= '9' && port <= (uint32_t)UINT16_MAX) {
    port = port * 10u + (uint32_t)(text[i] - '0');
    ++i;
  }
  return text[i] == '\0' && port <= (uint32_t)UINT16_MAX ? (uint16_t)port : 0u;
}

/* Connects a socket to an address of one family; -1: the text is none, or there is no socket. */
static int connect_v4(const char * ip, uint16_t port)
{
  struct sockaddr_in address;
  int handle = -1;

  (void)memset(&address, 0, sizeof(address));
  if (zsock_inet_pton(AF_INET, ip, &address.sin_addr) == 1) {
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    handle = zsock_socket(AF_INET, SOCK_DGRAM, IPPROTO_UDP);
    if (handle >= 0 && zsock_connect(handle, (struct sockaddr *)&address, sizeof(address)) != 0) {
      (void)zsock_close(handle);
      handle = -1;
    }
  }
  return handle;
}

static int connect_v6(const char * ip, uint16_t port)
{
  struct sockaddr_in6 address;
  int handle = -1;

  (void)memset(&address, 0, sizeof(address));
  if (zsock_inet_pton(AF_INET6, ip, &address.sin6_addr) == 1) {
    address.sin6_family = AF_INET6;
    address.sin6_port = htons(port);
    handle = zsock_socket(AF_INET6, SOCK_DGRAM, IPPROTO_UDP);
    if (handle >= 0 && zsock_connect(handle, (struct sockaddr *)&address, sizeof(address)) != 0) {
      (void)zsock_close(handle);
      handle = -1;
    }
  }
  return handle;
}

/* Called again after each outage of the agent. */
bool zephyr_transport_open(struct uxrCustomTransport * transport)
{
  zephyr_transport_params_t * params = params_of(transport);
  const uint16_t port = port_parse(params->port);
  int handle = -1;

  if (port != 0u) {
    handle = connect_v4(params->ip, port);
    if (handle < 0) {
      handle = connect_v6(params->ip, port);
    }
  }
  params->poll_fd.fd = handle;
  params->poll_fd.events = ZSOCK_POLLIN;
  return handle >= 0;
}

bool zephyr_transport_close(struct uxrCustomTransport * transport)
{
  zephyr_transport_params_t * params = params_of(transport);
  const bool is_closed = params->poll_fd.fd < 0 || zsock_close(params->poll_fd.fd) == 0;

  params->poll_fd.fd = -1;
  return is_closed;
}

size_t zephyr_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const ssize_t sent = zsock_send(params_of(transport)->poll_fd.fd, buf, len, 0);

  *err = (uint8_t)(sent < 0 ? 1u : 0u);
  return sent < 0 ? 0u : (size_t)sent;
}

/* While nobody listens at the agent's port, a read reports what the network said of it: that is no fault of the socket. */
size_t zephyr_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  zephyr_transport_params_t * params = params_of(transport);
  const int ready = zsock_poll(&params->poll_fd, 1, timeout);
  ssize_t size = 0;

  if (ready > 0) {
    size = zsock_recv(params->poll_fd.fd, buf, len, ZSOCK_MSG_DONTWAIT);
  }
  *err = ready < 0 || (size < 0 && errno != ECONNREFUSED && errno != EAGAIN) ? 1u : 0u;
  return size < 0 ? 0u : (size_t)size;
}
