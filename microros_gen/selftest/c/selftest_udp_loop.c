/* SPDX-License-Identifier: Apache-2.0 */
/* A socket that is its own peer: what it sends arrives at itself. */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_config.h"
#include "selftest_lengths.h"
#include "selftest_report.h"

enum { FIRST_PORT = 47160, PORTS = 8, PATIENCE_MS = 200, SMALL = 4, BYTES = 8 };

static uint8_t sent[SELFTEST_MTU];
static uint8_t received[SELFTEST_MTU];

static bool open_loop(port_udp_t * udp)
{
  for (uint16_t i = 0; i < (uint16_t)PORTS; ++i) {
    const uint16_t port = (uint16_t)((uint16_t)FIRST_PORT + i);

    if (port_udp_open_local(udp, "127.0.0.1", port, port)) {
      if (port_udp_local(udp) == port) {
        return true;
      }
      port_udp_close(udp);
    }
  }
  return false;
}

/* An empty datagram counts as none. */
static int32_t receive(port_udp_t * udp, size_t capacity)
{
  const uint32_t start_ms = port_time_ms();
  int32_t size = 0;

  while (size == 0 && port_time_ms() - start_ms < (uint32_t)PATIENCE_MS) {
    size = port_udp_receive(udp, received, capacity);
    if (size == 0) {
      port_sleep_ms(1);
    }
  }
  return size;
}

/* Returns the first length that does not arrive as it was sent; 0 if all do. */
static size_t wrong_length(port_udp_t * udp)
{
  for (size_t size = 1; size != 0u; size = selftest_next_length(size, sizeof(sent))) {
    selftest_fill(sent, size);
    if (
      !port_udp_send(udp, sent, size) || receive(udp, sizeof(received)) != (int32_t)size ||
      !selftest_is_filled(received, size)) {
      return size;
    }
  }
  return 0;
}

void selftest_udp_loop(void)
{
  port_udp_t udp;

  if (!open_loop(&udp)) {
    selftest_skip("udp_lengths", "no socket to this device itself (127.0.0.1)");
    return;
  }
  selftest_equal(
    "udp_lengths", (int64_t)wrong_length(&udp), 0, "as the first length that did not arrive as sent");
  (void)port_udp_send(&udp, sent, 0); /* whether it is sent or refused: the next one arrives */
  selftest_fill(sent, BYTES);
  (void)port_udp_send(&udp, sent, BYTES);
  selftest_equal("udp_after_an_empty_one", (int64_t)receive(&udp, sizeof(received)), (int64_t)BYTES, "bytes");
  (void)port_udp_send(&udp, sent, BYTES);
  selftest_equal("udp_too_large", (int64_t)receive(&udp, SMALL), -1, "for 8 bytes into 4");
  port_udp_close(&udp);
}
