/* SPDX-License-Identifier: Apache-2.0 */
/* Lateness of each declared timer: fast 10 ms, twin 10 ms, slow 1 s; one changes its period. */
#include "microros/rcl_diagnosis.h"
#include "microros/rcl_timer.h"
#include "microros/rcl_timer_watch.h"

#include <stdio.h>
#include <stdlib.h>

enum { FAST, TWIN, SLOW };

static const int64_t ms = 1000000;

rcl_timer_impl_t rcl_timers[MICROROS_TIMERS_MAX];

#define EXPECT(condition) \
  do { \
    if (!(condition)) { \
      (void)fprintf(stderr, "line %d: %s\n", __LINE__, #condition); \
      exit(1); \
    } \
  } while (0)

/* Calls the timer of a place so many nanoseconds after it was due. */
static void call(size_t place, int64_t late)
{
  rcl_timer_watch(&rcl_timers[place], rcl_timers[place].next_call_time + late);
}

static bool are(uint32_t fast_us, uint32_t twin_us, uint32_t slow_us)
{
  return rcl_diagnosis_timer_us(FAST) == fast_us && rcl_diagnosis_timer_us(TWIN) == twin_us &&
         rcl_diagnosis_timer_us(SLOW) == slow_us;
}

int main(void)
{
  static rcl_clock_t clock = {.type = RCL_STEADY_TIME};
  static const int64_t periods[] = {1000, 10, 10};

  for (size_t i = 0; i < sizeof(periods) / sizeof(periods[0]); ++i) {
    rcl_timers[i].clock = &clock;
    rcl_timers[i].period = periods[i] * ms;
    rcl_timers[i].next_call_time = 5 * ms;
  }
  call(0, 0);
  call(1, -1);
  EXPECT(are(0, 0, 0));
  call(1, 2 * ms);
  EXPECT(are(2000, 0, 0));
  call(2, 3 * ms);
  call(2, 1 * ms);
  EXPECT(are(2000, 3000, 0));
  call(0, 500 * ms);
  EXPECT(are(2000, 3000, 500000) && rcl_diagnosis_overruns() == 0);
  rcl_timers[0].period = 7 * ms; /* no declared one: of all timers alone */
  call(0, 900 * ms);
  EXPECT(are(2000, 3000, 500000) && rcl_diagnosis_latest_us() == 900000 && rcl_diagnosis_overruns() == 1);
  rcl_timers[0].period = 1000 * ms;
  rcl_timers[1].clock = NULL; /* the twin is the first one of its period now */
  call(2, 4 * ms);
  EXPECT(are(4000, 3000, 500000));
  call(0, INT64_MAX - 5 * ms);
  EXPECT(rcl_diagnosis_timer_us(SLOW) == UINT32_MAX / 1000u);
  (void)printf("ok\n");
  return 0;
}
