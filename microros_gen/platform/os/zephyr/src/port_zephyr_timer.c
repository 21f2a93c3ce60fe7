/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Timers of the kernel: they tick in the interrupt of its clock. The kernel keeps their phase: a late tick does not delay
 * the following ones.
 */
#include "microros/port.h"
#include "microros/port_zephyr.h"
#include "microros_config.h"

#include <stddef.h>

typedef struct kernel_timer_t {
  struct k_timer timer;
  port_timer_tick_t tick;
  uint16_t number;
  bool is_running;
} kernel_timer_t;

static const int64_t ns_per_s = 1000000000;

static kernel_timer_t kernel_timers[MICROROS_TIMERS_MAX];

static void timer_ticks(struct k_timer * timer)
{
  const kernel_timer_t * place = CONTAINER_OF(timer, kernel_timer_t, timer);

  place->tick(place->number);
}

/* Returns the period in ticks of the kernel; 0 if it is no whole number of them: rounded, it would drift. */
static int64_t period_in_ticks(int64_t period_ns)
{
  const int64_t hz = CONFIG_SYS_CLOCK_TICKS_PER_SEC;
  const int64_t seconds = period_ns / ns_per_s;
  const int64_t rest = period_ns % ns_per_s * hz;

  return period_ns <= 0 || rest % ns_per_s != 0 ? 0 : seconds * hz + rest / ns_per_s;
}

bool port_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick)
{
  kernel_timer_t * place = &kernel_timers[timer];
  const int64_t period = period_in_ticks(period_ns);

  if (period == 0 || place->is_running) {
    return false;
  }
  place->tick = tick;
  place->number = timer;
  place->is_running = true;
  k_timer_init(&place->timer, timer_ticks, NULL);
  k_timer_start(&place->timer, K_TICKS(period), K_TICKS(period));
  return true;
}

void port_timer_stop(uint16_t timer)
{
  kernel_timer_t * place = &kernel_timers[timer];

  if (place->is_running) {
    k_timer_stop(&place->timer);
    place->is_running = false;
  }
}
