/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros/port_bare_wait.h"
#include "microros/port_board.h"
#include "microros/port_uart.h"

/* One byte is never used, so that a full ring differs from an empty one. Only the interrupt writes `put` and `lost`, only the
 * task `taken`. */
static struct {
  volatile uint32_t put;
  volatile uint32_t taken;
  volatile uint32_t lost;
  volatile uint8_t bytes[PORT_BOARD_RING_SIZE];
} port_ring;

/* The other direction: only the task writes `put`, only the interrupt `sent`. Upwards, as a DMA controller reads. */
static struct {
  volatile uint32_t put;
  volatile uint32_t sent;
  volatile uint8_t bytes[PORT_BOARD_OUTPUT_SIZE];
} port_output;

/* A message that is not copied: it is sent after everything before `turn`. The task sets `next` while it is NULL; both may
 * end the message. */
static struct {
  volatile port_serial_next_t next;
  void * context;
  uint32_t turn;
} port_kept;

/* Returns the place `count` bytes further, which is not beyond the end. */
static uint32_t output_after(uint32_t at, uint32_t count)
{
  return at + count == PORT_BOARD_OUTPUT_SIZE ? 0u : at + count;
}

/* Downwards: comparing with 0 takes less code. */
static uint32_t ring_next(uint32_t at)
{
  return (at == 0u ? PORT_BOARD_RING_SIZE : at) - 1u;
}

void port_uart_received(uint8_t byte)
{
  const uint32_t put = port_ring.put;
  const uint32_t next = ring_next(put);

  port_ring.bytes[put] = byte; /* not read before `put` has passed it */
  if (next == port_ring.taken) {
    port_uart_lost();
  } else {
    port_ring.put = next;
  }
}

void port_uart_lost(void)
{
  port_ring.lost = port_ring.lost + 1u;
}

uint32_t port_bare_serial_lost(void)
{
  return port_ring.lost;
}

bool port_bare_serial_arrived(void)
{
  return port_ring.put != port_ring.taken;
}

bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  (void)device; /* the board has only one */
  serial->handle = 0;
  if (baud != PORT_BOARD_UART_BAUD) {
    return false;
  }
  port_uart_start();
  return true;
}

/* Unsent bytes are dropped, because opening the line again begins a new session. */
void port_serial_close(port_serial_t * serial)
{
  serial->handle = 0;
  port_uart_stop();
  port_serial_break_off(serial);
  port_output.sent = port_output.put;
}

size_t port_serial_room(port_serial_t * serial)
{
  const uint32_t put = port_output.put;
  const uint32_t sent = port_output.sent;

  (void)serial;
  return (sent > put ? sent : sent + PORT_BOARD_OUTPUT_SIZE) - put - 1u;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  uint32_t put = port_output.put;

  if (size > port_serial_room(serial)) {
    return false;
  }
  for (size_t i = 0; i < size; ++i) {
    port_output.bytes[put] = data[i]; /* not sent before `put` has passed it */
    put = output_after(put, 1);
  }
  port_output.put = put;
  port_uart_send();
  return true;
}

bool port_serial_send_kept(port_serial_t * serial, port_serial_next_t next, void * context)
{
  if (port_serial_has_kept(serial)) {
    return false;
  }
  port_kept.context = context;
  port_kept.turn = port_output.put;
  port_kept.next = next; /* from now on it belongs to the interrupt */
  port_uart_send();
  return true;
}

void port_serial_break_off(port_serial_t * serial)
{
  (void)serial;
  if (PORT_BOARD_KEEPS_OUTPUT) {
    port_kept.next = NULL;
  }
}

bool port_serial_has_kept(const port_serial_t * serial)
{
  (void)serial;
  return PORT_BOARD_KEEPS_OUTPUT && port_kept.next != NULL;
}

bool port_serial_is_idle(port_serial_t * serial)
{
  return port_output.sent == port_output.put && !port_serial_has_kept(serial);
}

/* Takes the next byte of a message that is not copied. */
static bool kept_next(uint32_t sent, uint8_t * byte)
{
  const port_serial_next_t next = port_kept.next;
  int32_t given;

  if (next == NULL || sent != port_kept.turn) {
    return false;
  }
  given = next(port_kept.context);
  if (given < 0) {
    port_kept.next = NULL;
    return false;
  }
  *byte = (uint8_t)given;
  return true;
}

bool port_uart_next(uint8_t * byte)
{
  const uint32_t sent = port_output.sent;

  if (PORT_BOARD_KEEPS_OUTPUT && kept_next(sent, byte)) {
    return true;
  }
  if (sent == port_output.put) {
    return false;
  }
  *byte = port_output.bytes[sent];
  port_output.sent = output_after(sent, 1);
  return true;
}

uint32_t port_uart_unsent(const volatile uint8_t ** bytes)
{
  const uint32_t put = port_output.put;
  const uint32_t sent = port_output.sent;

  *bytes = &port_output.bytes[sent];
  return (put < sent ? PORT_BOARD_OUTPUT_SIZE : put) - sent;
}

void port_uart_sent(uint32_t count)
{
  port_output.sent = output_after(port_output.sent, count);
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  uint32_t taken = port_ring.taken;
  size_t count = 0;

  (void)serial;
  while (count < capacity && taken != port_ring.put) {
    buffer[count] = port_ring.bytes[taken];
    taken = ring_next(taken);
    ++count;
  }
  port_ring.taken = taken;
  return count;
}
