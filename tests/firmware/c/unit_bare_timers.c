/* SPDX-License-Identifier: Apache-2.0 */
/* The system's timers of a board and its steady time, while the milliseconds run through 2^31 and 2^32 in steps of days. */
#include "port_bare_time_timers.c"

#include "port_bare_steady.c"

#include "unit_expect.h"

enum { STEPS = 12, DAY_MS = 86400000, LONG = 0, SHORT = 1 };

static uint32_t ticks[2];

static void on_tick(uint16_t timer)
{
  ++ticks[timer];
}

/* Days go by in which the short timer rests: the interrupt would have ticked in each millisecond. */
static void pass(uint32_t duration_ms)
{
  port_bare_now_ms += duration_ms - 1u;
  port_bare_tick();
}

static void ticks_over_sixty_days(void)
{
  const int64_t ms = 1000000;
  const int64_t begin_ns = port_time_steady_ns();
  int64_t days_ns = 0;

  EXPECT(port_timer_start(LONG, (int64_t)5 * DAY_MS * ms, on_tick));
  for (uint32_t step = 1; step <= (uint32_t)STEPS; ++step) {
    pass(5u * (uint32_t)DAY_MS);
    days_ns += (int64_t)5 * DAY_MS * ms;
    EXPECT(ticks[LONG] == step);
    EXPECT(port_time_steady_ns() - begin_ns == days_ns);
    EXPECT(port_timer_start(SHORT, 10 * ms, on_tick));
    for (uint32_t i = 0; i < 20u; ++i) {
      port_bare_tick();
    }
    EXPECT(ticks[SHORT] == 2u * step);
    port_timer_stop(SHORT);
    for (uint32_t i = 0; i < 20u; ++i) {
      port_bare_tick();
    }
    EXPECT(ticks[SHORT] == 2u * step && ticks[LONG] == step);
    port_bare_now_ms -= 40u; /* the steps stay whole */
  }
}

static void starts_again_while_it_runs(void)
{
  ticks[SHORT] = 0;
  EXPECT(port_timer_start(SHORT, 10000000, on_tick) && port_timer_start(SHORT, 30000000, on_tick));
  for (uint32_t i = 0; i < 29u; ++i) {
    port_bare_tick();
  }
  EXPECT(ticks[SHORT] == 0u);
  port_bare_tick();
  EXPECT(ticks[SHORT] == 1u);
  EXPECT(!port_timer_start(LONG, (int64_t)INT32_MAX * 1000000 + 1, on_tick));
  EXPECT(port_timer_start(LONG, (int64_t)INT32_MAX * 1000000, on_tick));
}

int main(void)
{
  ticks_over_sixty_days();
  starts_again_while_it_runs();
  return failures == 0 ? 0 : 1;
}
