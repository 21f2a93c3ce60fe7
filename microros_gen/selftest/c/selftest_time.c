/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_clock.h"

#include <stddef.h>

static uint64_t now(void)
{
  return port_time_ms();
}

bool selftest_time(void)
{
  static const selftest_clock_t clock = {
    now, UINT64_C(1) << 32, 1, "time_never_backwards", "time_resolution", NULL};

  return selftest_clock(&clock);
}
