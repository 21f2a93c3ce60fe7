/* SPDX-License-Identifier: Apache-2.0 */
/* An application for a board whose serial line it drives itself. */
#include <microros/port.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>

void mine_uart_interrupt(void);

void mine_uart_interrupt(void)
{
}

#ifdef OWN_SERIAL
bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  (void)device;
  serial->handle = 1;
  return baud != 0u;
}

void port_serial_close(port_serial_t * serial)
{
  serial->handle = 0;
}

size_t port_serial_room(port_serial_t * serial)
{
  return serial->handle != 0 ? SIZE_MAX : 0u;
}

bool port_serial_is_idle(port_serial_t * serial)
{
  return serial->handle == 0;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  (void)data;
  return serial->handle != 0 && size != 0u;
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  (void)serial;
  (void)buffer;
  return capacity == 0u ? 1u : 0u;
}
#endif

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK ? 0 : 1;
}
