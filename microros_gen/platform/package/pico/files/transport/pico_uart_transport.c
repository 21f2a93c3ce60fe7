/* SPDX-License-Identifier: Apache-2.0 */
#include "pico_uart_transports.h"

#include "pico/stdio.h"

static bool is_open;

/* Called again after each outage of the agent. */
bool pico_serial_transport_open(struct uxrCustomTransport * transport)
{
  (void)transport;
  if (!is_open) {
    is_open = stdio_init_all();
  }
  return is_open;
}

bool pico_serial_transport_close(struct uxrCustomTransport * transport)
{
  (void)transport;
  return true;
}

/* Without a computer at the USB port, the SDK drops the bytes after a time-out. */
size_t pico_serial_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  (void)transport;
  for (size_t i = 0; i < len; ++i) {
    (void)putchar_raw(buf[i]);
  }
  stdio_flush();
  *err = 0;
  return len;
}

/* Waits for the first byte alone: the library calls again for more. */
size_t pico_serial_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  uint32_t wait_us = timeout > 0 ? (uint32_t)timeout * 1000u : 0u;
  size_t count = 0;

  (void)transport;
  *err = 0;
  while (count < len) {
    const int next = getchar_timeout_us(wait_us);

    if (next < 0) {
      break;
    }
    buf[count] = (uint8_t)next;
    ++count;
    wait_us = 0;
  }
  return count;
}
