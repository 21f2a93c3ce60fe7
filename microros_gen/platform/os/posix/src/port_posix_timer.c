/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Timers of the system: one thread each, which sleeps until the next tick. No signal is used, so no call of the application
 * is interrupted. A late tick on a busy machine does not delay the following ones.
 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"
#include "microros_config.h"

#include <errno.h>
#include <pthread.h>
#include <stddef.h>
#include <time.h>

enum { NS_PER_S = 1000000000 };

typedef struct posix_timer_t {
  pthread_t thread;
  struct timespec next;
  int64_t period_ns;
  port_timer_tick_t tick;
  uint16_t timer;
  bool running;
} posix_timer_t;

static posix_timer_t posix_timers[MICROROS_TIMERS_MAX];

static void timer_advance(posix_timer_t * timer)
{
  const int64_t ns = (int64_t)timer->next.tv_nsec + timer->period_ns % NS_PER_S;

  timer->next.tv_sec += (time_t)(timer->period_ns / NS_PER_S + ns / NS_PER_S);
  timer->next.tv_nsec = (long)(ns % NS_PER_S);
}

/* Ended by pthread_cancel, only while it sleeps. */
static void * timer_run(void * argument)
{
  posix_timer_t * timer = argument;
  int state = 0;

  for (;;) {
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &timer->next, NULL) == EINTR) {
      /* interrupted by a signal of the application: continue to sleep */
    }
    (void)pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &state);
    timer->tick(timer->timer);
    (void)pthread_setcancelstate(state, NULL);
    timer_advance(timer);
  }
  return NULL;
}

bool port_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick)
{
  posix_timer_t * place = &posix_timers[timer];

  if (period_ns <= 0 || place->running || clock_gettime(CLOCK_MONOTONIC, &place->next) != 0) {
    return false;
  }
  place->timer = timer;
  place->period_ns = period_ns;
  place->tick = tick;
  timer_advance(place);
  place->running = pthread_create(&place->thread, NULL, timer_run, place) == 0;
  return place->running;
}

void port_timer_stop(uint16_t timer)
{
  posix_timer_t * place = &posix_timers[timer];

  if (place->running) {
    (void)pthread_cancel(place->thread);
    (void)pthread_join(place->thread, NULL);
    place->running = false;
  }
}
