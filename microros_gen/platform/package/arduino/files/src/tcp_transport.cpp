/* SPDX-License-Identifier: Apache-2.0 */
/* TCP: each message follows its length, two bytes, the lower one first. */
#include <micro_ros_arduino.h>

#include "micro_ros_arduino_wait.h"

struct tcp_transport_t {
  Client * client;
  IPAddress agent_ip;
  uint16_t agent_port;
  size_t expected; /* length of the message that arrives; 0: its length has not arrived */
};

static struct tcp_transport_t tcp_transport;

static bool tcp_open(struct uxrCustomTransport * transport)
{
  struct tcp_transport_t & own = *(struct tcp_transport_t *)transport->args;

  own.client->stop(); /* a lost session leaves an old connection */
  own.expected = 0;
  return own.client->connect(own.agent_ip, own.agent_port) == 1;
}

static bool tcp_close(struct uxrCustomTransport * transport)
{
  ((struct tcp_transport_t *)transport->args)->client->stop();
  return true;
}

/* After a part of a message the other side cannot find the next one, so the connection ends. */
static size_t tcp_write(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t length, uint8_t * error)
{
  Client & client = *((struct tcp_transport_t *)transport->args)->client;
  const uint8_t head[2] = {(uint8_t)(length & 0xFFu), (uint8_t)((length >> 8) & 0xFFu)};

  (void)error;
  if (!client.connected()) {
    return 0;
  }
  if (client.write(head, sizeof(head)) != sizeof(head) || client.write(buffer, length) != length) {
    client.stop();
    return 0;
  }
  return length;
}

/* Returns whether a whole message is there, `expected` bytes. */
static bool tcp_is_whole(struct tcp_transport_t & own)
{
  if (own.expected == 0 && own.client->available() >= 2) {
    const int lower = own.client->read();
    const int upper = own.client->read();

    own.expected = (size_t)(lower & 0xFF) | ((size_t)(upper & 0xFF) << 8);
  }
  return own.expected != 0 && own.client->available() >= (int)own.expected;
}

static size_t tcp_read(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t length, int timeout, uint8_t * error)
{
  struct tcp_transport_t & own = *(struct tcp_transport_t *)transport->args;
  const uint32_t start_ms = millis();

  (void)error;
  while (!tcp_is_whole(own)) {
    if (own.expected > length) {
      own.client->stop(); /* no message of the agent is that long: the stream is not one of an agent */
      own.expected = 0;
    }
    if (!arduino_wait(start_ms, timeout)) {
      return 0;
    }
  }
  const size_t size = own.expected;
  own.expected = 0;
  return own.client->read(buffer, size) == (int)size ? size : 0;
}

bool set_microros_tcp_transport(Client & client, IPAddress agent_ip, uint16_t agent_port)
{
  tcp_transport.client = &client;
  tcp_transport.agent_ip = agent_ip;
  tcp_transport.agent_port = agent_port;
  return rmw_uros_set_custom_transport(false, &tcp_transport, tcp_open, tcp_close, tcp_write, tcp_read) ==
         RMW_RET_OK;
}
