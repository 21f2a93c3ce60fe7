/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The agent of measured.h at the end of a serial line: it takes the place of the UART and its driver, whose work does not
 * count. The frames are the client's own work (OMG DDS-XRCE 1.0, C.1).
 */
#ifndef MEASURED_SERIAL_H
#define MEASURED_SERIAL_H

#include "measured.h"

#include <microros/port_bare.h>
#include <microros/port_bare_wait.h>
#include <microros/port_uart.h>

enum { FLAG = 0x7e, ESCAPE = 0x7d, FLIP = 0x20, FRAME_HEADER = 4, LINE_SIZE = 512 };

static uint8_t sent[LINE_SIZE]; /* of the frame that the client sends, without stuffing */
static size_t sent_size;
static bool sent_escaped;
static uint8_t arriving[LINE_SIZE];
static size_t arriving_size;
static size_t arriving_read;

/* Takes a byte of the client's; a whole frame goes to the agent. */
static void line_take(uint8_t byte)
{
  static port_udp_t agent;

  if (byte == FLAG) {
    sent_size = 0;
    return;
  }
  if (byte == ESCAPE) {
    sent_escaped = true;
    return;
  }
  if (sent_size < LINE_SIZE) {
    sent[sent_size] = sent_escaped ? (uint8_t)(byte ^ FLIP) : byte;
    ++sent_size;
  }
  sent_escaped = false;
  if (
    sent_size > FRAME_HEADER &&
    sent_size == (size_t)FRAME_HEADER + (sent[2] | (size_t)sent[3] << 8) + 2u) { /* and the checksum */
    (void)port_udp_send(&agent, &sent[FRAME_HEADER], sent_size - FRAME_HEADER - 2u);
    sent_size = 0;
  }
}

static void line_stuff(uint8_t byte)
{
  if (byte == FLAG || byte == ESCAPE) {
    arriving[arriving_size] = ESCAPE;
    ++arriving_size;
    byte ^= FLIP;
  }
  arriving[arriving_size] = byte;
  ++arriving_size;
}

static uint16_t line_crc(uint16_t crc, uint8_t byte)
{
  crc ^= byte;
  for (volatile uint32_t i = 0; i < 8u; ++i) {
    crc = (uint16_t)((crc & 1u) != 0u ? crc >> 1 ^ 0xa001u : crc >> 1);
  }
  return crc;
}

/* Puts the next answer of the agent on the line. */
static void line_frame(void)
{
  static uint8_t message[ANSWER_SIZE];
  static port_udp_t agent;
  const int32_t size = port_udp_receive(&agent, message, sizeof(message));
  uint16_t crc = 0;

  if (size <= 0) {
    return;
  }
  arriving_size = 0;
  arriving_read = 0;
  arriving[arriving_size] = FLAG;
  ++arriving_size;
  line_stuff(0);
  line_stuff(1);
  line_stuff((uint8_t)size);
  line_stuff((uint8_t)(size >> 8));
  for (volatile int32_t i = 0; i < size; ++i) {
    crc = line_crc(crc, message[i]);
    line_stuff(message[i]);
  }
  line_stuff((uint8_t)crc);
  line_stuff((uint8_t)(crc >> 8));
}

bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  static port_udp_t agent;

  (void)device;
  (void)baud;
  serial->handle = 0;
  arriving_size = 0;
  arriving_read = 0;
  return port_udp_open(&agent, "", 0);
}

void port_serial_close(port_serial_t * serial)
{
  serial->handle = 0;
}

size_t port_serial_room(port_serial_t * serial)
{
  (void)serial;
  return LINE_SIZE;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  (void)serial;
  for (volatile size_t i = 0; i < size; ++i) {
    line_take(data[i]);
  }
  return true;
}

bool port_serial_send_kept(port_serial_t * serial, port_serial_next_t next, void * context)
{
  (void)serial;
  for (int32_t byte = next(context); byte >= 0; byte = next(context)) {
    line_take((uint8_t)byte);
  }
  return true;
}

void port_serial_break_off(port_serial_t * serial)
{
  (void)serial;
}

bool port_serial_has_kept(const port_serial_t * serial)
{
  (void)serial;
  return false;
}

bool port_serial_is_idle(port_serial_t * serial)
{
  (void)serial;
  return true;
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  volatile size_t count = 0;

  (void)serial;
  if (arriving_read == arriving_size) {
    line_frame();
  }
  while (count < capacity && arriving_read < arriving_size) {
    buffer[count] = arriving[arriving_read];
    ++arriving_read;
    ++count;
  }
  return count;
}

void port_uart_received(uint8_t byte)
{
  (void)byte;
}

void port_uart_lost(void)
{
}

uint32_t port_bare_serial_lost(void)
{
  return 0;
}

bool port_bare_serial_arrived(void)
{
  return arriving_read < arriving_size || waiting != 0u;
}

bool port_uart_next(uint8_t * byte)
{
  (void)byte;
  return false;
}

uint32_t port_uart_unsent(const volatile uint8_t ** bytes)
{
  *bytes = sent;
  return 0;
}

void port_uart_sent(uint32_t count)
{
  (void)count;
}

#endif /* MEASURED_SERIAL_H */
