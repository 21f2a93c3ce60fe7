/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_clock.h"

static uint64_t now(void)
{
  return (uint64_t)port_time_steady_ns();
}

void selftest_steady(void)
{
  static const selftest_clock_t clock = {
    now, 0, 1000000, "steady_never_backwards", "steady_resolution", "steady_agrees"};

  (void)selftest_clock(&clock);
  selftest_clock_agrees(&clock);
}
