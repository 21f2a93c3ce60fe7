/* SPDX-License-Identifier: Apache-2.0 */
/* UDP: one datagram is one message. */
#include <micro_ros_arduino.h>

#include "micro_ros_arduino_wait.h"

struct udp_transport_t {
  UDP * udp;
  IPAddress agent_ip;
  uint16_t agent_port;
};

static struct udp_transport_t udp_transport;

static bool udp_open(struct uxrCustomTransport * transport)
{
  struct udp_transport_t & own = *(struct udp_transport_t *)transport->args;

  return own.udp->begin(own.agent_port) == 1;
}

static bool udp_close(struct uxrCustomTransport * transport)
{
  ((struct udp_transport_t *)transport->args)->udp->stop();
  return true;
}

static size_t udp_write(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t length, uint8_t * error)
{
  struct udp_transport_t & own = *(struct udp_transport_t *)transport->args;

  (void)error;
  if (own.udp->beginPacket(own.agent_ip, own.agent_port) != 1) {
    return 0;
  }
  const size_t written = own.udp->write(buffer, length);
  return own.udp->endPacket() == 1 ? written : 0;
}

/* Returns the next datagram of the agent. Those of others, and those that do not fit, are dropped. */
static size_t udp_read(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t length, int timeout, uint8_t * error)
{
  struct udp_transport_t & own = *(struct udp_transport_t *)transport->args;
  const uint32_t start_ms = millis();

  (void)error;
  do {
    const int size = own.udp->parsePacket();

    if (size > 0 && (size_t)size <= length && own.udp->remoteIP() == own.agent_ip) {
      return own.udp->read(buffer, (size_t)size) == size ? (size_t)size : 0;
    }
    while (size > 0 && own.udp->available() > 0 && own.udp->read() >= 0) {
    }
  } while (arduino_wait(start_ms, timeout));
  return 0;
}

bool set_microros_udp_transport(UDP & udp, IPAddress agent_ip, uint16_t agent_port)
{
  udp_transport.udp = &udp;
  udp_transport.agent_ip = agent_ip;
  udp_transport.agent_port = agent_port;
  return rmw_uros_set_custom_transport(false, &udp_transport, udp_open, udp_close, udp_write, udp_read) ==
         RMW_RET_OK;
}
