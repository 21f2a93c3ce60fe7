/* SPDX-License-Identifier: Apache-2.0 */
/* Waiting and timers of the POSIX port, in real time: lower bounds are exact, upper ones generous. */
#include "unit.h"

#include <microros/port.h>

#include <stdbool.h>
#include <stdint.h>

static const int64_t ms = 1000000;

static volatile uint32_t ticks;

static void tick(uint16_t timer)
{
  CHECK(timer == 1u);
  ticks = ticks + 1u;
  port_wake();
}

static int64_t waited(uint32_t timeout_ms)
{
  const int64_t start = port_time_steady_ns();

  port_wait(-1, timeout_ms);
  return port_time_steady_ns() - start;
}

int main(void)
{
  int64_t start;
  uint32_t before;

  CHECK(waited(30) >= 29 * ms);
  port_wake();
  port_wake();
  CHECK(waited(5000) < 4000 * ms);
  CHECK(waited(30) >= 29 * ms); /* two calls are one */
  CHECK(!port_timer_start(1, 0, tick));
  CHECK(port_timer_start(1, 20 * ms, tick) && !port_timer_start(1, 20 * ms, tick));
  start = port_time_steady_ns();
  while (ticks < 5u) {
    port_wait(-1, 1000);
  }
  CHECK(port_time_steady_ns() - start >= 80 * ms);
  port_timer_stop(1);
  port_timer_stop(1);
  before = ticks;
  port_wait(-1, 1); /* what came before the stop */
  CHECK(waited(60) >= 59 * ms && ticks == before);
  CHECK(port_timer_start(1, 5 * ms, tick));
  CHECK(waited(5000) < 4000 * ms);
  port_timer_stop(1);
  return 0;
}
