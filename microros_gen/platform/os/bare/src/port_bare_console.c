/* SPDX-License-Identifier: Apache-2.0 */
/* Log lines are written to standard output (`stdio` of the target file). */
#include "microros/port_console.h"

#include "microros/port_stdio.h"

/* Waits until the line has taken `size` bytes. On a stalled line a byte is lost after a time-out (port_stdio_put). */
bool port_console_write(const char * line, size_t size)
{
  for (size_t i = 0; i < size; ++i) {
    port_stdio_put((uint8_t)line[i]);
  }
  return true;
}
