/* SPDX-License-Identifier: Apache-2.0 */
/* The millisecond timer, which drives the timers of the port. */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros_config.h"

/* One word, read and written atomically; only the interrupt writes it. */
static volatile uint32_t port_bare_now_ms;

/* `tick` is written last when a timer starts, and first when it stops. In between, only the interrupt writes `due_ms`. */
typedef struct port_bare_timer_t {
  volatile port_timer_tick_t tick; /* NULL: stopped */
  volatile uint32_t period_ms;
  volatile uint32_t due_ms;
} port_bare_timer_t;

static port_bare_timer_t port_bare_timers[MICROROS_TIMERS_MAX];

static void port_bare_timer_look(uint16_t index, uint32_t now_ms)
{
  port_bare_timer_t * timer = &port_bare_timers[index];
  const port_timer_tick_t tick = timer->tick;

  if (tick != NULL && now_ms - timer->due_ms <= (uint32_t)INT32_MAX) {
    timer->due_ms = timer->due_ms + timer->period_ms;
    tick(index);
  }
}

void port_bare_tick(void)
{
  const uint32_t now_ms = port_bare_now_ms + 1u;

  port_bare_now_ms = now_ms;
  for (uint16_t i = 0; i < MICROROS_TIMERS_MAX; ++i) {
    port_bare_timer_look(i, now_ms);
  }
}

uint32_t port_time_ms(void)
{
  return port_bare_now_ms;
}

/* Whole milliseconds, rounded up. */
bool port_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick)
{
  static const int64_t ns_per_ms = 1000000;
  const int64_t period_ms = (period_ns + ns_per_ms - 1) / ns_per_ms;
  port_bare_timer_t * place = &port_bare_timers[timer];

  if (period_ms <= 0 || period_ms > (int64_t)INT32_MAX) {
    return false;
  }
  place->tick = NULL; /* a running timer must not tick halfway */
  place->due_ms = port_time_ms() + (uint32_t)period_ms;
  place->period_ms = (uint32_t)period_ms;
  place->tick = tick;
  return true;
}

void port_timer_stop(uint16_t timer)
{
  port_bare_timers[timer].tick = NULL;
}
