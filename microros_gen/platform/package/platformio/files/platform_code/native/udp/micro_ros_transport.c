/* SPDX-License-Identifier: Apache-2.0 */
#define _DEFAULT_SOURCE
#include "micro_ros_platformio.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <poll.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

static int udp = -1;

bool platformio_transport_open(struct uxrCustomTransport * transport)
{
  const micro_ros_agent_locator * agent = (const micro_ros_agent_locator *)transport->args;
  struct sockaddr_in peer;

  (void)memset(&peer, 0, sizeof(peer));
  peer.sin_family = AF_INET;
  peer.sin_port = htons(agent->port);
  udp = socket(AF_INET, SOCK_DGRAM, 0);
  return udp >= 0 && inet_pton(AF_INET, agent->address, &peer.sin_addr) == 1 &&
         connect(udp, (const struct sockaddr *)&peer, (socklen_t)sizeof(peer)) == 0;
}

bool platformio_transport_close(struct uxrCustomTransport * transport)
{
  const bool is_closed = udp < 0 || close(udp) == 0;

  (void)transport;
  udp = -1;
  return is_closed;
}

size_t platformio_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const ssize_t sent = send(udp, buf, len, 0);

  (void)transport;
  *err = sent < 0 ? 1 : 0;
  return sent < 0 ? 0u : (size_t)sent;
}

/* An error is that of an ICMP message: nobody listens there yet. */
size_t platformio_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  struct pollfd waiting = {udp, POLLIN, 0};
  ssize_t size = 0;

  (void)transport;
  *err = 0;
  if (poll(&waiting, 1, timeout) > 0) {
    size = recv(udp, buf, len, MSG_DONTWAIT);
  }
  return size < 0 ? 0u : (size_t)size;
}
