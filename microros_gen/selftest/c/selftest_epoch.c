/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_clock.h"
#include "selftest_report.h"

static uint64_t now(void)
{
  return (uint64_t)port_time_epoch_ns();
}

/* The time of day may be corrected, also backwards, but not within these milliseconds. Until somebody sets it, it may stand. */
void selftest_epoch(void)
{
  static const int64_t year_2020_ns = INT64_C(1577836800) * 1000000000;
  static const selftest_clock_t clock = {
    now, 0, 1000000, "epoch_never_backwards", "epoch_resolution", "epoch_agrees"};

  if (port_time_epoch_ns() < year_2020_ns) {
    selftest_skip("epoch", "nothing has set the time of day");
    return;
  }
  (void)selftest_clock(&clock);
  selftest_clock_agrees(&clock);
}
