/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_report.h"

enum { BYTES = 4, NOBODY = 9, PATIENCE_MS = 500, ZERO_MS = 10 };

static port_tcp_t tcp;

static void receive(void)
{
  uint8_t buffer[BYTES];

  (void)port_tcp_receive(&tcp, buffer, sizeof(buffer));
}

/* Nobody listens at the port: the connection is refused, which both functions say with -1. */
static void check_refused(void)
{
  static const uint8_t bytes[BYTES] = {0};
  const uint32_t start_ms = port_time_ms();
  int32_t result = 0;

  while (result == 0 && port_time_ms() - start_ms < (uint32_t)PATIENCE_MS) {
    result = port_tcp_send(&tcp, bytes, sizeof(bytes));
    port_sleep_ms(1);
  }
  if (result == 0) {
    selftest_skip("tcp_refused", "the network drops what is sent to 127.0.0.1:9");
  } else {
    selftest_equal("tcp_refused", (int64_t)result, -1, "of port_tcp_send to a port without a listener");
  }
}

void selftest_tcp(void)
{
  port_tcp_t other;

  selftest_true(
    "tcp_refuses_a_wrong_address", !port_tcp_open(&other, "no address", 1), "a connection",
    "none for the text 'no address'");
  if (!port_tcp_open(&tcp, "127.0.0.1", (uint16_t)NOBODY)) {
    selftest_skip("tcp_refused", "no connection to this device itself (127.0.0.1)");
    return;
  }
  selftest_at_most("tcp_receive_never_waits", (int64_t)selftest_shortest_ms(receive), (int64_t)ZERO_MS, "ms");
  check_refused();
  port_tcp_close(&tcp);
}
