/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_board.h"
#include "microros/port_console.h"
#include "microros/port_console_uart.h"

/* One byte is never used, so that a full ring differs from an empty one. Only the task writes `put`, only the interrupt
 * `sent`. */
static struct {
  volatile uint32_t put;
  volatile uint32_t sent;
  volatile uint8_t bytes[PORT_BOARD_CONSOLE_SIZE + 1u];
} port_console;

static bool console_recovers; /* a line was dropped, and less than half of the ring was free since then */

static uint32_t console_after(uint32_t at, uint32_t count)
{
  return at + count > PORT_BOARD_CONSOLE_SIZE ? 0u : at + count;
}

static uint32_t console_room(void)
{
  const uint32_t put = port_console.put;
  const uint32_t sent = port_console.sent;

  return (sent > put ? sent : sent + PORT_BOARD_CONSOLE_SIZE + 1u) - put - 1u;
}

bool port_console_put(const uint8_t * bytes, size_t size)
{
  uint32_t put = port_console.put;

  if (size > console_room()) {
    return false;
  }
  for (size_t i = 0; i < size; ++i) {
    port_console.bytes[put] = bytes[i]; /* the interrupt does not read it before `put` has passed it */
    put = console_after(put, 1);
  }
  port_console.put = put;
  port_console_send();
  return true;
}

/* After a dropped line, waits for half of the ring: otherwise every other line would report a dropped one. */
bool port_console_write(const char * line, size_t size)
{
  if (console_recovers && console_room() < PORT_BOARD_CONSOLE_SIZE / 2u) {
    return false;
  }
  console_recovers = !port_console_put((const uint8_t *)line, size);
  return !console_recovers;
}

bool port_console_next(uint8_t * byte)
{
  const uint32_t sent = port_console.sent;

  if (sent == port_console.put) {
    return false;
  }
  *byte = port_console.bytes[sent];
  port_console.sent = console_after(sent, 1);
  return true;
}

uint32_t port_console_unsent(const volatile uint8_t ** bytes)
{
  const uint32_t put = port_console.put;
  const uint32_t sent = port_console.sent;

  *bytes = &port_console.bytes[sent];
  return (put < sent ? PORT_BOARD_CONSOLE_SIZE + 1u : put) - sent;
}

void port_console_sent(uint32_t count)
{
  port_console.sent = console_after(port_console.sent, count);
}

bool port_console_is_idle(void)
{
  return port_console.sent == port_console.put;
}
