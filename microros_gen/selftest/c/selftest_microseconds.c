/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_diagnosis.h"
#include "selftest_checks.h"
#include "selftest_clock.h"

static uint64_t now(void)
{
  return port_time_us();
}

void selftest_microseconds(void)
{
  static const selftest_clock_t clock = {
    now,
    UINT64_C(1) << 32,
    1000,
    "microseconds_never_backwards",
    "microseconds_resolution",
    "microseconds_agree"};

  (void)selftest_clock(&clock);
  selftest_clock_agrees(&clock);
}
