/* SPDX-License-Identifier: Apache-2.0 */
/* What can be seen without an agent: who answers a group is not on this device. */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_report.h"

enum { BYTES = 4, NOBODY = 9, ZERO_MS = 10 };

static port_multicast_t multicast;

static void receive(void)
{
  uint8_t sender[PORT_MULTICAST_ADDRESS];
  uint8_t buffer[BYTES];

  (void)port_multicast_receive(&multicast, buffer, sizeof(buffer), sender);
}

void selftest_multicast(void)
{
  static const uint8_t bytes[BYTES] = {0};
  uint8_t sender[PORT_MULTICAST_ADDRESS];
  uint8_t buffer[BYTES];

  if (!port_multicast_open(&multicast)) {
    selftest_true("multicast_open", false, "no socket", "one; the network is up?");
    return;
  }
  selftest_true("multicast_open", true, "", "");
  selftest_true(
    "multicast_refuses_a_wrong_group",
    !port_multicast_send(&multicast, "no address", NOBODY, bytes, sizeof(bytes)), "a datagram that was sent",
    "none: 'no address' is not an IPv4 address");
  selftest_true(
    "multicast_send", port_multicast_send(&multicast, "127.0.0.1", NOBODY, bytes, sizeof(bytes)),
    "a datagram that was not sent", "one to this device itself");
  selftest_equal(
    "multicast_receive_nothing", (int64_t)port_multicast_receive(&multicast, buffer, sizeof(buffer), sender),
    0, "bytes");
  selftest_at_most(
    "multicast_receive_never_waits", (int64_t)selftest_shortest_ms(receive), (int64_t)ZERO_MS, "ms");
  port_multicast_close(&multicast);
}
