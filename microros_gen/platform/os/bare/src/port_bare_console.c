/* SPDX-License-Identifier: Apache-2.0 */
/* Lines of log messages go where standard output goes (`stdio` of the target file). */
#include "microros/port_console.h"

#include "microros/port_stdio.h"

/* Waits as long as the line of a UART takes for `size` bytes, and loses a byte on a line that sends nothing
 * (port_stdio_put). */
bool port_console_write(const char * line, size_t size)
{
  for (size_t i = 0; i < size; ++i) {
    port_stdio_put((uint8_t)line[i]);
  }
  return true;
}
