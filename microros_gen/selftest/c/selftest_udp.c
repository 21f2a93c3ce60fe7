/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_config.h"
#include "selftest_report.h"

enum { ZERO_MS = 10, BYTES = 8 };

static port_udp_t udp;

static void receive(void)
{
  uint8_t buffer[BYTES];

  (void)port_udp_receive(&udp, buffer, sizeof(buffer));
}

void selftest_udp(void)
{
  static const char * const wrong = "no address";
  uint8_t buffer[BYTES];
  port_udp_t other;

  selftest_true(
    "udp_refuses_a_wrong_address", !port_udp_open(&other, wrong, 1), "a socket",
    "none for the text 'no address'");
  if (!port_udp_open(&udp, SELFTEST_HOST, (uint16_t)SELFTEST_PORT)) {
    selftest_true(
      "udp_open", false, "no socket", "one to the agent at " SELFTEST_HOST "; the network is up?");
    return;
  }
  selftest_true("udp_open", true, "", "");
  selftest_equal("udp_receive_nothing", (int64_t)port_udp_receive(&udp, buffer, sizeof(buffer)), 0, "bytes");
  selftest_at_most("udp_receive_never_waits", (int64_t)selftest_shortest_ms(receive), (int64_t)ZERO_MS, "ms");
  port_udp_close(&udp);
}
