/* SPDX-License-Identifier: Apache-2.0 */
/* A program that has the functions of the serial line itself, on a system that has some, too. */
#include "unit.h"

#include <microros/port.h>

#include <stdbool.h>

enum { LONG_MS = 60000 };

bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  (void)device, (void)baud;
  serial->handle = -1;
  return true;
}

void port_serial_close(port_serial_t * serial)
{
  (void)serial;
}

size_t port_serial_room(port_serial_t * serial)
{
  (void)serial;
  return 0;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  (void)serial, (void)data, (void)size;
  return false;
}

bool port_serial_is_idle(port_serial_t * serial)
{
  (void)serial;
  return true;
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  (void)serial, (void)buffer, (void)capacity;
  return 0;
}

int main(void)
{
  port_serial_t serial;

  CHECK(port_serial_open(&serial, "mine", 0));
  port_wake();
  port_wait(serial.handle, LONG_MS); /* ends at once */
  return 0;
}
