/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_report.h"

enum { NO_HANDLE = -1, PERIOD_MS = 20, LONG_MS = 500, WOKEN_MS = 250 };

/* In the interrupt, or the task of the system that has its timers. */
static void tick(uint16_t timer)
{
  (void)timer;
  port_wake();
}

/* Waits until it has taken as long as the timer's period: a wait may also end before. */
static void wait_for_tick(void)
{
  const uint32_t start_ms = port_time_ms();

  while (port_time_ms() - start_ms < (uint32_t)PERIOD_MS) {
    port_wait((intptr_t)NO_HANDLE, (uint32_t)LONG_MS);
  }
}

void selftest_timer_wake(void)
{
  if (port_timer_start(0, (int64_t)PERIOD_MS * 1000000, tick)) {
    selftest_at_most(
      "wake_from_timer", (int64_t)selftest_shortest_ms(wait_for_tick), (int64_t)WOKEN_MS, "ms");
    port_timer_stop(0);
  } else {
    selftest_true("wake_from_timer", false, "no timer", "timer 0");
  }
}
