/* SPDX-License-Identifier: Apache-2.0 */
/* What microros/cdr_double.h computes. For each 8 bytes of a float64 it answers the 4 bytes that they become, and the
 * 8 bytes that those become again; all of the target's byte order. On a computer the line is standard input and output.
 *
 * On an AVR it first sends a message of test_msgs/msg/Defaults as it is after its __init, and its constants. */
#ifndef __AVR__
#include <microros/cdr_double.h>
#include <stdio.h>

static bool receive(uint8_t * bytes)
{
  return fread(bytes, 1, 8, stdin) == 8;
}

static void send(const void * bytes, size_t size)
{
  (void)fwrite(bytes, 1, size, stdout);
}

static void start(void)
{
}
#else
#include <avr/io.h>
#include <microros/cdr_decode_double.h>
#include <microros/cdr_double.h>
#include <test_msgs/msg/defaults.h>

static void send(const void * bytes, size_t size)
{
  for (size_t i = 0; i < size; ++i) {
    while ((UCSR0A & _BV(UDRE0)) == 0) {
    }
    UDR0 = ((const uint8_t *)bytes)[i];
  }
}

static bool receive(uint8_t * bytes)
{
  for (uint8_t i = 0; i < 8; ++i) {
    while ((UCSR0A & _BV(RXC0)) == 0) {
    }
    bytes[i] = UDR0;
  }
  return true;
}

static void start(void)
{
  const double constants[] = {
    test_msgs__msg__Defaults__TENTH, test_msgs__msg__Defaults__LARGE, test_msgs__msg__Defaults__SMALL,
    test_msgs__msg__Defaults__HALFWAY};
  static test_msgs__msg__Defaults message;
  static test_msgs__msg__Defaults__Storage storage;

  UBRR0 = 16;
  UCSR0A = _BV(U2X0);
  UCSR0B = _BV(RXEN0) | _BV(TXEN0);
  test_msgs__msg__Defaults__bind(&message, &storage);
  send(constants, sizeof(constants));
  send(&message.number, sizeof(message.number));
  send(message.numbers, sizeof(message.numbers));
  send(message.several.data, message.several.size * sizeof(double));
}
#endif

int main(void)
{
  uint8_t wire[8];

  start();
  while (receive(wire)) {
    uint32_t halves[2];
    uint32_t bits;

    for (uint8_t i = 0; i < 2; ++i) {
      halves[i] = wire[4 * i] | (uint32_t)wire[4 * i + 1] << 8 | (uint32_t)wire[4 * i + 2] << 16 |
                  (uint32_t)wire[4 * i + 3] << 24;
    }
    bits = cdr_double_narrow(halves[1], halves[0]);
    send(&bits, sizeof(bits));
    cdr_double_widen(wire, bits);
    send(wire, sizeof(wire));
  }
  return 0;
}
