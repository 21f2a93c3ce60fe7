/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_report.h"

enum {
  TICKS = 20,
  HALF = 10,
  PERIOD_MS = 10,
  EARLY_MS = 1,
  GROWTH_MS = 3,
  LATE_MS = 10,
  QUIET_MS = 35,
  SPAN_MS = 235
};

/* Written by the tick, read when the timer was stopped; `count` also before. */
static struct {
  volatile uint32_t count;
  uint32_t times_ms[TICKS];
} ticks;

static void tick(uint16_t timer)
{
  const uint32_t count = ticks.count;

  (void)timer;
  if (count < (uint32_t)TICKS) {
    ticks.times_ms[count] = port_time_ms();
  }
  ticks.count = count + 1u;
}

/* The least delay of half of the ticks: that of the timer, without what delays a single tick. */
static int64_t least_late_ms(uint32_t start_ms, uint32_t first)
{
  int64_t least = INT64_MAX;

  for (uint32_t i = first; i < first + (uint32_t)HALF; ++i) {
    const int64_t due = (int64_t)(i + 1u) * (int64_t)PERIOD_MS;
    const int64_t late = (int64_t)(int32_t)(ticks.times_ms[i] - start_ms) - due;

    least = late < least ? late : least;
  }
  return least;
}

static void check_times(uint32_t start_ms)
{
  const int64_t late = least_late_ms(start_ms, 0);
  const int64_t growth = least_late_ms(start_ms, (uint32_t)HALF) - late;

  selftest_at_least("timer_not_early", late, -(int64_t)EARLY_MS, "ms after the tick was due");
  selftest_at_most("timer_not_late", late, (int64_t)LATE_MS, "ms after the tick was due");
  selftest_at_most(
    "timer_no_drift", growth < 0 ? -growth : growth, (int64_t)GROWTH_MS, "ms of drift in 10 periods");
}

void selftest_timer(void)
{
  static const int64_t period_ns = (int64_t)PERIOD_MS * 1000000;
  const uint32_t start_ms = port_time_ms();
  uint32_t stopped;

  ticks.count = 0;
  if (!port_timer_start(0, period_ns, tick)) {
    selftest_true("timer_start", false, "no timer", "timer 0");
    return;
  }
  port_sleep_ms((uint32_t)SPAN_MS);
  port_timer_stop(0);
  stopped = ticks.count;
  selftest_at_least("timer_ticks", (int64_t)stopped, (int64_t)TICKS, "ticks in 20 periods");
  if (stopped >= (uint32_t)TICKS) {
    check_times(start_ms);
  }
  port_sleep_ms((uint32_t)QUIET_MS);
  selftest_equal("timer_stops", (int64_t)(ticks.count - stopped), 0, "ticks after the stop");
}
