/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros/port_bare_wait.h"
#include "microros/port_board.h"
#include "microros/port_uart.h"

/* One byte is never used: so a full ring differs from an empty one. The interrupt alone writes `put` and `lost`, the task alone
 * `taken`. */
static struct {
  volatile uint32_t put;
  volatile uint32_t taken;
  volatile uint32_t lost;
  volatile uint8_t bytes[PORT_BOARD_RING_SIZE];
} port_ring;

/* Downwards: it is shorter to see that 0 is reached. */
static uint32_t ring_next(uint32_t at)
{
  return (at == 0u ? PORT_BOARD_RING_SIZE : at) - 1u;
}

void port_uart_received(uint8_t byte)
{
  const uint32_t put = port_ring.put;
  const uint32_t next = ring_next(put);

  port_ring.bytes[put] = byte; /* nobody reads it before `put` has gone on */
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
  (void)device; /* there is one */
  serial->handle = 0;
  if (baud != PORT_BOARD_UART_BAUD) {
    return false;
  }
  port_uart_start();
  return true;
}

void port_serial_close(port_serial_t * serial)
{
  serial->handle = 0;
  port_uart_stop();
}

/* Waits for the pace of the line, ten bits a byte: 512 bytes at 115200 baud take 44 ms. A line that stands still costs
 * PORT_UART_BYTE_TIMEOUT_MS. */
bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  bool taken = true;

  (void)serial;
  for (size_t i = 0; i < size && taken; ++i) {
    taken = port_uart_put(data[i]);
  }
  return taken;
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
