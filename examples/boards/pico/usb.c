/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The transport of a Raspberry Pi Pico: its USB serial device, through the standard input and output of the Pico SDK. The
 * Pico SDK has start-up code, clocks and time; so time and sleep of microros/port.h are the SDK's too.
 */
#include "../counter.h"

#include <microros/port.h>
#include <rmw_microros/rmw_microros.h>
#include <uxr/client/transport.h>

#include <pico/stdio.h>
#include <pico/time.h>

uint32_t port_time_ms(void)
{
  return to_ms_since_boot(get_absolute_time());
}

void port_sleep_ms(uint32_t duration_ms)
{
  sleep_ms(duration_ms);
}

static bool usb_open(struct uxrCustomTransport * transport)
{
  (void)transport;
  return true; /* stdio_init_all() has opened it */
}

static bool usb_close(struct uxrCustomTransport * transport)
{
  (void)transport;
  return true;
}

static size_t usb_write(
  struct uxrCustomTransport * transport, const uint8_t * bytes, size_t size, uint8_t * error)
{
  (void)transport;
  for (size_t i = 0; i < size; ++i) {
    (void)putchar_raw(bytes[i]);
  }
  stdio_flush();
  *error = 0;
  return size;
}

static size_t usb_read(
  struct uxrCustomTransport * transport, uint8_t * bytes, size_t size, int timeout_ms, uint8_t * error)
{
  uint32_t wait_us = timeout_ms > 0 ? (uint32_t)timeout_ms * 1000u : 0u;
  size_t count = 0;

  (void)transport;
  *error = 0;
  while (count < size) {
    const int next = getchar_timeout_us(wait_us);

    if (next < 0) {
      break;
    }
    bytes[count] = (uint8_t)next;
    ++count;
    wait_us = 0; /* what has arrived already */
  }
  return count;
}

int main(void)
{
  (void)stdio_init_all();
  if (rmw_uros_set_custom_transport(true, NULL, usb_open, usb_close, usb_write, usb_read) != RMW_RET_OK) {
    return 1;
  }
  for (;;) {
    counter_run(); /* again until there is an agent */
  }
}
