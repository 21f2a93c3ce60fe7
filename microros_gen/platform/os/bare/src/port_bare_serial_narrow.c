/* SPDX-License-Identifier: Apache-2.0 */
/* The rings of the serial line (port_bare_serial.c), for a processor that reads a number in parts. Functions of the interrupt
 * are called with interrupts off. */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros/port_bare_narrow.h"
#include "microros/port_bare_wait.h"
#include "microros/port_board.h"
#include "microros/port_uart.h"

/* One byte is never used, so that a full ring differs from an empty one. Only the interrupt writes `put` and `lost`, only the
 * task `taken`. */
static struct {
  volatile uint16_t put;
  volatile uint16_t taken;
  volatile uint16_t lost;
  volatile uint8_t bytes[PORT_BOARD_RING_SIZE];
} port_ring;

/* The other direction: only the task writes `put`, only the interrupt `sent`. */
static struct {
  volatile uint16_t put;
  volatile uint16_t sent;
  volatile uint8_t bytes[PORT_BOARD_OUTPUT_SIZE];
} port_output;

/* A message that is not copied: it is sent after everything before `turn`. The task sets `next` while it is NULL; both may
 * end the message. */
static struct {
  volatile port_serial_next_t next;
  void * context;
  uint16_t turn;
} port_kept;

static uint16_t index_read(const volatile uint16_t * index)
{
  const uint8_t state = port_bare_interrupts_off();
  const uint16_t value = *index;

  port_bare_interrupts_restore(state);
  return value;
}

static void index_write(volatile uint16_t * index, uint16_t value)
{
  const uint8_t state = port_bare_interrupts_off();

  *index = value;
  port_bare_interrupts_restore(state);
}

static void kept_set(port_serial_next_t next)
{
  const uint8_t state = port_bare_interrupts_off();

  port_kept.next = next;
  port_bare_interrupts_restore(state);
}

static uint16_t output_after(uint16_t at)
{
  return at + 1u == PORT_BOARD_OUTPUT_SIZE ? 0u : at + 1u;
}

static uint16_t ring_after(uint16_t at)
{
  return at + 1u == PORT_BOARD_RING_SIZE ? 0u : at + 1u;
}

void port_uart_received(uint8_t byte)
{
  const uint16_t put = port_ring.put;
  const uint16_t next = ring_after(put);

  port_ring.bytes[put] = byte;
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
  return index_read(&port_ring.lost);
}

bool port_bare_serial_arrived(void)
{
  return index_read(&port_ring.put) != port_ring.taken;
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
  port_output.sent = port_output.put; /* the interrupt is off */
}

size_t port_serial_room(port_serial_t * serial)
{
  const uint16_t put = port_output.put;
  const uint16_t sent = index_read(&port_output.sent);

  (void)serial;
  return (size_t)(sent > put ? sent : sent + PORT_BOARD_OUTPUT_SIZE) - put - 1u;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  uint16_t put = port_output.put;

  if (size > port_serial_room(serial)) {
    return false;
  }
  for (size_t i = 0; i < size; ++i) {
    port_output.bytes[put] = data[i]; /* not sent before `put` has passed it */
    put = output_after(put);
  }
  index_write(&port_output.put, put);
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
  kept_set(next); /* from now on it belongs to the interrupt */
  port_uart_send();
  return true;
}

void port_serial_break_off(port_serial_t * serial)
{
  (void)serial;
  if (PORT_BOARD_KEEPS_OUTPUT) {
    kept_set(NULL);
  }
}

bool port_serial_has_kept(const port_serial_t * serial)
{
  uint8_t state;
  bool has_kept;

  (void)serial;
  if (!PORT_BOARD_KEEPS_OUTPUT) {
    return false;
  }
  state = port_bare_interrupts_off();
  has_kept = port_kept.next != NULL;
  port_bare_interrupts_restore(state);
  return has_kept;
}

bool port_serial_is_idle(port_serial_t * serial)
{
  return index_read(&port_output.sent) == port_output.put && !port_serial_has_kept(serial);
}

/* Takes the next byte of a message that is not copied. */
static bool kept_next(uint16_t sent, uint8_t * byte)
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
  const uint16_t sent = port_output.sent;

  if (PORT_BOARD_KEEPS_OUTPUT && kept_next(sent, byte)) {
    return true;
  }
  if (sent == port_output.put) {
    return false;
  }
  *byte = port_output.bytes[sent];
  port_output.sent = output_after(sent);
  return true;
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  const uint16_t put = index_read(&port_ring.put);
  uint16_t taken = port_ring.taken;
  size_t count = 0;

  (void)serial;
  while (count < capacity && taken != put) {
    buffer[count] = port_ring.bytes[taken];
    taken = ring_after(taken);
    ++count;
  }
  index_write(&port_ring.taken, taken);
  return count;
}
