/* SPDX-License-Identifier: Apache-2.0 */
/* The line may be looped (TX to RX): then each message comes back, in each length that the port accepts at once. */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_config.h"
#include "selftest_lengths.h"
#include "selftest_report.h"

enum { BYTES = 8, ZERO_MS = 10, PATIENCE_MS = 300, BITS = 10, MS_PER_S = 1000 };

static port_serial_t serial;
static uint8_t sent[SELFTEST_MTU];
static uint8_t received[SELFTEST_MTU];

static void read_nothing(void)
{
  uint8_t buffer[BYTES];

  (void)port_serial_read(&serial, buffer, sizeof(buffer));
}

/* Returns how many bytes came back before the line was silent for too long. */
static size_t read_back(size_t size)
{
  const uint32_t line_ms = (uint32_t)size * (uint32_t)BITS * (uint32_t)MS_PER_S / (uint32_t)SELFTEST_BAUD;
  const uint32_t start_ms = port_time_ms();
  size_t count = 0;

  while (count < size && port_time_ms() - start_ms < line_ms + (uint32_t)PATIENCE_MS) {
    const size_t read = port_serial_read(&serial, &received[count], size - count);

    count += read;
    if (read == 0u) {
      port_sleep_ms(1);
    }
  }
  return count;
}

static bool comes_back(size_t size)
{
  selftest_fill(sent, size);
  return port_serial_write(&serial, sent, size) && read_back(size) == size &&
         selftest_is_filled(received, size);
}

static size_t largest(void)
{
  const size_t room = port_serial_room(&serial);

  return room < sizeof(sent) ? room : sizeof(sent);
}

static size_t wrong_length(void)
{
  for (size_t size = 1; size != 0u; size = selftest_next_length(size, largest())) {
    if (!comes_back(size)) {
      return size;
    }
  }
  return 0;
}

static void check_idle(void)
{
  const uint32_t start_ms = port_time_ms();

  while (!port_serial_is_idle(&serial) && port_time_ms() - start_ms < (uint32_t)PATIENCE_MS) {
    port_sleep_ms(1);
  }
  selftest_true("serial_becomes_idle", port_serial_is_idle(&serial), "bytes that wait after 300 ms", "none");
}

static void check_loop(void)
{
  selftest_fill(sent, 1);
  if (!port_serial_write(&serial, sent, 1)) {
    selftest_true("serial_write", false, "a byte that was refused", "one that was taken");
    return;
  }
  check_idle();
  if (read_back(1) == 0u) {
    selftest_skip("serial_lengths", "nothing came back: connect TX to RX");
    return;
  }
  selftest_equal(
    "serial_lengths", (int64_t)wrong_length(), 0, "as the first length that did not come back as written");
}

void selftest_serial(void)
{
  if (!port_serial_open(&serial, SELFTEST_DEVICE, (uint32_t)SELFTEST_BAUD)) {
    selftest_true("serial_open", false, "no line", "the line '" SELFTEST_DEVICE "'");
    return;
  }
  selftest_true("serial_open", true, "", "");
  selftest_at_least("serial_room", (int64_t)largest(), 1, "bytes");
  selftest_true(
    "serial_write_nothing", port_serial_write(&serial, sent, 0), "a refusal", "no bytes to be taken");
  selftest_at_most(
    "serial_read_never_waits", (int64_t)selftest_shortest_ms(read_nothing), (int64_t)ZERO_MS, "ms");
  check_loop();
  port_serial_close(&serial);
  selftest_true(
    "serial_opens_again", port_serial_open(&serial, SELFTEST_DEVICE, (uint32_t)SELFTEST_BAUD), "no line",
    "a line");
  port_serial_close(&serial);
}
