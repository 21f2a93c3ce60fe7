/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The agent of measured.h at the end of a TCP connection: it takes the place of the network. The lengths before the messages
 * are the client's own work (OMG DDS-XRCE 1.0, 11.3). TCP_CHUNK: bytes that a call takes or gives at most.
 */
#ifndef MEASURED_TCP_H
#define MEASURED_TCP_H

#include "measured.h"

enum { TCP_SIZE = 512, TCP_LENGTH = 2 };

#ifndef TCP_CHUNK
#define TCP_CHUNK TCP_SIZE
#endif

static uint8_t tcp_sent[TCP_SIZE];
static size_t tcp_sent_size;
static uint8_t tcp_arriving[TCP_SIZE];
static size_t tcp_arriving_size;
static size_t tcp_arriving_read;

/* Hands whole messages to the agent. */
static void tcp_take(uint8_t byte)
{
  static port_udp_t agent;

  if (tcp_sent_size < (size_t)TCP_SIZE) {
    tcp_sent[tcp_sent_size] = byte;
    ++tcp_sent_size;
  }
  if (
    tcp_sent_size >= (size_t)TCP_LENGTH &&
    tcp_sent_size == (size_t)TCP_LENGTH + (tcp_sent[0] | (size_t)tcp_sent[1] << 8)) {
    (void)port_udp_send(&agent, &tcp_sent[TCP_LENGTH], tcp_sent_size - TCP_LENGTH);
    tcp_sent_size = 0;
  }
}

/* Puts the next answer of the agent, after its length, into what arrives. */
static void tcp_answer(void)
{
  static uint8_t message[ANSWER_SIZE];
  static port_udp_t agent;
  const int32_t size = port_udp_receive(&agent, message, sizeof(message));

  if (size > 0) {
    tcp_arriving[0] = (uint8_t)size;
    tcp_arriving[1] = (uint8_t)(size >> 8);
    put(&tcp_arriving[TCP_LENGTH], message, (size_t)size);
    tcp_arriving_size = (size_t)TCP_LENGTH + (size_t)size;
    tcp_arriving_read = 0;
  }
}

bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port)
{
  static port_udp_t agent;

  tcp->handle = 1;
  tcp_sent_size = 0;
  tcp_arriving_size = 0;
  tcp_arriving_read = 0;
  return port_udp_open(&agent, host, port);
}

void port_tcp_close(port_tcp_t * tcp)
{
  tcp->handle = 0;
}

int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size)
{
  const size_t taken = size < (size_t)TCP_CHUNK ? size : (size_t)TCP_CHUNK;

  (void)tcp;
  for (volatile size_t i = 0; i < taken; ++i) {
    tcp_take(data[i]);
  }
  return (int32_t)taken;
}

int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity)
{
  volatile size_t count = 0;

  (void)tcp;
  if (tcp_arriving_read == tcp_arriving_size) {
    tcp_answer();
  }
  while (count < capacity && count < (size_t)TCP_CHUNK && tcp_arriving_read < tcp_arriving_size) {
    buffer[count] = tcp_arriving[tcp_arriving_read];
    ++tcp_arriving_read;
    ++count;
  }
  return (int32_t)count;
}

#endif /* MEASURED_TCP_H */
