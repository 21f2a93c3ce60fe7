/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The network of a board: an adapter at its UART, which the test plays (tests/support/firmware/uart_network.py). A datagram
 * is the port of the agent, two bytes, and the message, in a frame of RFC 1055.
 */
#ifndef UART_NETWORK_H
#define UART_NETWORK_H

#include <microros/port.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { END = 0xc0, ESCAPE = 0xdb, ESCAPED_END = 0xdc, ESCAPED_ESCAPE = 0xdd, HEAD = 2, LARGEST = 600 };

/* The CMSDK UART 0 of the MPS2. */
#define UART ((volatile uint32_t *)0x40004000u)
enum { DATA = 0, STATE = 1, CONTROL = 2, DIVISOR = 4, IS_FULL = 1u, HAS_BYTE = 2u, BOTH = 3u, DIVIDED = 16u };

static uint8_t arrived[LARGEST];
static size_t count;
static bool is_escaped;

static void put_byte(uint8_t byte)
{
  while ((UART[STATE] & (uint32_t)IS_FULL) != 0u) { /* for a byte at most */
  }
  UART[DATA] = byte;
}

static void put_escaped(uint8_t byte)
{
  if (byte == (uint8_t)END || byte == (uint8_t)ESCAPE) {
    put_byte(ESCAPE);
    put_byte(byte == (uint8_t)END ? (uint8_t)ESCAPED_END : (uint8_t)ESCAPED_ESCAPE);
  } else {
    put_byte(byte);
  }
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  (void)host;
  UART[DIVISOR] = DIVIDED;
  UART[CONTROL] = BOTH;
  udp->handle = (intptr_t)port;
  return true;
}

void port_udp_close(port_udp_t * udp)
{
  udp->handle = 0;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  put_byte(END);
  put_escaped((uint8_t)((uint32_t)udp->handle >> 8));
  put_escaped((uint8_t)((uint32_t)udp->handle & 0xffu));
  for (size_t i = 0; i < size; ++i) {
    put_escaped(data[i]);
  }
  put_byte(END);
  return true;
}

/* Adds a byte to the frame. Returns the size of a frame that it ends, otherwise 0. */
static size_t take(uint8_t byte)
{
  size_t size = 0;

  if (byte == (uint8_t)END) {
    size = count;
    count = 0;
    is_escaped = false;
  } else if (byte == (uint8_t)ESCAPE) {
    is_escaped = true;
  } else if (count < sizeof(arrived)) {
    arrived[count] = !is_escaped ? byte : byte == (uint8_t)ESCAPED_END ? (uint8_t)END : (uint8_t)ESCAPE;
    is_escaped = false;
    ++count;
  } else {
    count = 0;
  }
  return size;
}

/* A datagram of another agent than the one of the socket is left out, as a connected socket does. */
int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  while ((UART[STATE] & (uint32_t)HAS_BYTE) != 0u) {
    const size_t size = take((uint8_t)UART[DATA]);

    if (size > (size_t)HEAD && udp->handle == (intptr_t)((uint32_t)arrived[0] << 8 | arrived[1])) {
      if (size - (size_t)HEAD > capacity) {
        return -1;
      }
      for (volatile size_t i = HEAD; i < size; ++i) {
        buffer[i - (size_t)HEAD] = arrived[i];
      }
      return (int32_t)(size - (size_t)HEAD);
    }
  }
  return 0;
}

#endif /* UART_NETWORK_H */
