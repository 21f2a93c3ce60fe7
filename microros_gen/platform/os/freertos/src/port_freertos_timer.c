/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Timers of the kernel: they tick in its timer task, whose priority and stack FreeRTOSConfig.h sets. The kernel keeps
 * their phase: a late tick does not delay the following ones.
 */
#include "microros/port.h"
#include "microros/port_freertos.h"
#include "microros_config.h"

#include "task.h"
#include "timers.h"

#include <stddef.h>

#if !defined(configUSE_TIMERS) || configUSE_TIMERS != 1
#error "FreeRTOSConfig.h: set configUSE_TIMERS to 1"
#endif

typedef struct kernel_timer_t {
  StaticTimer_t storage;
  TimerHandle_t handle; /* NULL: not made yet */
  port_timer_tick_t tick;
  uint16_t timer;
} kernel_timer_t;

static const int64_t ns_per_s = 1000000000;

static kernel_timer_t kernel_timers[MICROROS_TIMERS_MAX];

static void timer_ticks(TimerHandle_t handle)
{
  const kernel_timer_t * place = (const kernel_timer_t *)pvTimerGetTimerID(handle);

  place->tick(place->timer);
}

/* Returns the period in ticks; 0 if it is none of them or cannot be counted. */
static TickType_t period_in_ticks(int64_t period_ns)
{
  const int64_t per_tick = ns_per_s / (int64_t)configTICK_RATE_HZ;

  if (period_ns <= 0 || period_ns % per_tick != 0 || period_ns / per_tick >= (int64_t)portMAX_DELAY) {
    return 0;
  }
  return (TickType_t)(period_ns / per_tick);
}

/* Returns false for a period that is no whole number of ticks. */
bool port_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick)
{
  kernel_timer_t * place = &kernel_timers[timer];
  const TickType_t period = period_in_ticks(period_ns);

  if (period == 0u || (place->handle != NULL && xTimerIsTimerActive(place->handle) != pdFALSE)) {
    return false;
  }
  place->tick = tick;
  place->timer = timer;
  if (place->handle == NULL) {
    place->handle = xTimerCreateStatic("microros", period, pdTRUE, place, timer_ticks, &place->storage);
  }
  return xTimerChangePeriod(place->handle, period, portMAX_DELAY) == pdPASS; /* starts it as well */
}

/* The timer task has a higher priority than those that stop timers, or it ends the timer at its next turn. */
void port_timer_stop(uint16_t timer)
{
  kernel_timer_t * place = &kernel_timers[timer];

  if (place->handle != NULL) {
    (void)xTimerStop(place->handle, portMAX_DELAY);
    while (xTimerIsTimerActive(place->handle) != pdFALSE) {
      vTaskDelay(1);
    }
  }
}
