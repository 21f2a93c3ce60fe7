/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The serial line of POSIX whose output waits for room: lost_line DEVICE. Says that nobody reads the terminal; after a line on
 * standard input, prints how many milliseconds waits of 0 ms took while the device is gone.
 */
#include "microros/port.h"
#include "microros/port_posix_serial.h"

#include <stdio.h>

enum { PART = 32, BAUD = 115200, WAITS = 40 };

static port_serial_t serial;

int main(int argc, char ** argv)
{
  uint8_t part[PART] = {0};
  char line[8];
  uint32_t start;

  if (argc != 2 || !port_serial_open(&serial, argv[1], BAUD)) {
    return 2;
  }
  while (port_serial_room(&serial) >= PART && port_serial_write(&serial, part, PART)) {
  }
  if (port_posix_serial_left(0) != 1u || port_posix_serial_left(5) != 5u) {
    return 5; /* a full line */
  }
  printf("full\n");
  (void)fflush(stdout);
  if (fgets(line, sizeof(line), stdin) == NULL) {
    return 3;
  }
  if (port_serial_read(&serial, part, sizeof(part)) != 0u || port_serial_room(&serial) != 0u) {
    return 4; /* the device is not gone */
  }
  start = port_time_ms();
  for (int i = 0; i < (int)WAITS; ++i) {
    port_wait(serial.handle, 0);
  }
  printf("%u\n", (unsigned)(port_time_ms() - start));
  port_serial_close(&serial);
  if (port_posix_serial_left(0) != 0u) {
    return 6; /* no line */
  }
  return 0;
}
