/* SPDX-License-Identifier: Apache-2.0 */
/* The serial line is unplugged and plugged in again: only where the application can do that. */
#include "selftest_checks.h"
#include "selftest_report.h"

#ifdef SELFTEST_LINK

#include "microros/port.h"
#include "selftest.h"
#include "selftest_link.h"

enum { ZERO_MS = 10, PATIENCE_MS = 200, CHUNKS = 64, BYTES = 64, SENT = 0x55 };

static const uint8_t sent = SENT;

static port_serial_t serial;
static bool is_open;
static uint8_t received[BYTES];

static void write_byte(void)
{
  (void)port_serial_write(&serial, &sent, sizeof(sent)); /* without a line it may be taken or refused */
}

static void read_bytes(void)
{
  (void)port_serial_read(&serial, received, sizeof(received));
}

static void close_line(void)
{
  if (is_open) {
    port_serial_close(&serial);
  }
  is_open = false;
}

/* Opens the line again: its device may have gone with the plug. */
static bool open_line(void)
{
  close_line();
  is_open = port_serial_open(&serial, SELFTEST_DEVICE, (uint32_t)SELFTEST_BAUD);
  return is_open;
}

/* Returns whether a byte comes back: TX may be connected to RX. */
static bool is_looped(void)
{
  const uint32_t start_ms = port_time_ms();
  bool has_returned = false;

  if (is_open && port_serial_write(&serial, &sent, sizeof(sent))) {
    while (!has_returned && port_time_ms() - start_ms < (uint32_t)PATIENCE_MS) {
      has_returned = port_serial_read(&serial, received, 1) == 1u && received[0] == sent;
      port_sleep_ms(1);
    }
  }
  return has_returned;
}

static void check_down(void)
{
  if (!is_open) {
    return;
  }
  selftest_equal(
    "serial_link_down_read_nothing", (int64_t)port_serial_read(&serial, received, sizeof(received)), 0,
    "bytes");
  selftest_at_most(
    "serial_link_down_read_never_waits", (int64_t)selftest_shortest_ms(read_bytes), (int64_t)ZERO_MS, "ms");
  selftest_at_most(
    "serial_link_down_write_never_waits", (int64_t)selftest_shortest_ms(write_byte), (int64_t)ZERO_MS, "ms");
}

static void check_up(bool was_looped)
{
  const selftest_link_t link = selftest_link_again(open_line, is_looped, was_looped);

  selftest_true("serial_link_up_opens", link.opens, "no line", "one within 2 s after it is plugged in");
  if (was_looped) {
    selftest_true(
      "serial_link_up_returns", link.is_answered, "nothing that came back",
      "a byte, as before the line was unplugged");
  } else {
    selftest_skip("serial_link_up_returns", "nothing came back while the line was there: connect TX to RX");
  }
}

void selftest_serial_link(void)
{
  const bool was_looped = open_line() && is_looped();

  selftest_set_link(false);
  for (uint8_t i = 0; i < (uint8_t)CHUNKS && is_open; ++i) {
    read_bytes(); /* what had arrived before */
  }
  check_down();
  selftest_set_link(true);
  check_up(was_looped);
  close_line();
}

#else

void selftest_serial_link(void)
{
  selftest_skip(
    "serial_link_down", "define selftest_set_link, and -DSELFTEST_LINK when you compile the self-test");
}

#endif
