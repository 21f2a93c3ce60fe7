/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The serial line of POSIX at a terminal that nobody reads: stuck_line DEVICE. Prints how many bytes were taken until there was
 * no room, and the most milliseconds that a call took; after a line on standard input, how many more it took to hand all of it
 * over, and then waits for the line to be idle. The bytes count up modulo 251.
 */
#include "microros/port.h"

#include <stdio.h>

enum { PART = 32, BAUD = 115200, WAIT_MS = 100, MOST_WAITS = 100 };

static uint32_t worst_ms;

static bool write_part(port_serial_t * serial, uint32_t at)
{
  uint8_t part[PART];
  const uint32_t start = port_time_ms();
  uint32_t taken_ms;
  bool taken;

  for (uint32_t i = 0; i < PART; ++i) {
    part[i] = (uint8_t)((at + i) % 251u);
  }
  taken = port_serial_room(serial) >= PART && port_serial_write(serial, part, PART);
  taken_ms = port_time_ms() - start;
  worst_ms = taken_ms > worst_ms ? taken_ms : worst_ms;
  return taken;
}

int main(int argc, char ** argv)
{
  port_serial_t serial;
  port_serial_t other;
  char line[8];
  uint32_t size = 0;
  int waits = 0;

  if (argc != 2 || !port_serial_open(&serial, argv[1], BAUD)) {
    return 2;
  }
  while (write_part(&serial, size)) {
    size += PART;
  }
  if (port_serial_is_idle(&serial) || port_serial_room(&serial) >= PART) {
    return 3;
  }
  if (!port_serial_open(&other, argv[1], BAUD) || port_serial_room(&other) == 0u) {
    return 4; /* another handle has its own buffer, and what waits in this one stays */
  }
  port_serial_close(&other);
  printf("%u %u\n", (unsigned)size, (unsigned)worst_ms);
  (void)fflush(stdout);
  if (fgets(line, sizeof(line), stdin) == NULL) {
    return 5;
  }
  while (!port_serial_is_idle(&serial) && waits < MOST_WAITS) {
    port_wait(serial.handle, WAIT_MS); /* ends when the terminal has room */
    ++waits;
  }
  printf("%d\n", waits);
  port_serial_close(&serial);
  return waits < MOST_WAITS ? 0 : 6;
}
