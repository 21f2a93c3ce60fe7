/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_report.h"

enum { TRIES = 4, LONGEST_MS = 20, ZERO_MS = 10, MORE_MS = 20 };

static void sleep_zero(void)
{
  port_sleep_ms(0);
}

static void sleep_longest(void)
{
  port_sleep_ms((uint32_t)LONGEST_MS);
}

/* Sleeps of several lengths, from different moments of the clock's step: none is too short. */
static int64_t least_extra_ms(void)
{
  static const uint32_t durations_ms[] = {1, 2, 7, (uint32_t)LONGEST_MS};
  int64_t least = INT64_MAX;

  for (uint32_t i = 0; i < (uint32_t)TRIES * (uint32_t)(sizeof(durations_ms) / sizeof(durations_ms[0]));
       ++i) {
    const uint32_t duration_ms = durations_ms[i / (uint32_t)TRIES];
    const uint32_t start = port_time_ms();
    int64_t extra;

    port_sleep_ms(duration_ms);
    extra = (int64_t)(port_time_ms() - start) - (int64_t)duration_ms;
    least = extra < least ? extra : least;
  }
  return least;
}

void selftest_sleep(void)
{
  selftest_at_least("sleep_lower_bound", least_extra_ms(), 0, "ms beyond the duration");
  selftest_at_most(
    "sleep_upper_bound", (int64_t)selftest_shortest_ms(sleep_longest), (int64_t)LONGEST_MS + (int64_t)MORE_MS,
    "ms");
  selftest_at_most("sleep_zero", (int64_t)selftest_shortest_ms(sleep_zero), (int64_t)ZERO_MS, "ms");
}
