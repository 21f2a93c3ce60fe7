/* SPDX-License-Identifier: Apache-2.0 */
#include "selftest_clock.h"

#include "microros/port.h"
#include "selftest_report.h"

enum { SPAN_MS = 25, LOOKS = 4000000, LARGEST_STEP_MS = 10, SLEEP_MS = 50, TRIES = 3 };

typedef struct seen_t {
  uint64_t passed;
  uint64_t smallest;
  uint32_t backwards;
} seen_t;

static uint64_t difference(const selftest_clock_t * clock, uint64_t from, uint64_t to)
{
  return clock->wraps_at != 0u ? (to - from) % clock->wraps_at : to - from;
}

/* More than half of all times is a step back. */
static bool is_back(const selftest_clock_t * clock, uint64_t passed)
{
  const uint64_t half = clock->wraps_at != 0u ? clock->wraps_at / 2u : UINT64_MAX / 2u;

  return passed > half;
}

static seen_t look(const selftest_clock_t * clock)
{
  seen_t seen = {0, UINT64_MAX, 0};
  uint64_t last = clock->now();

  for (uint32_t i = 0; i < (uint32_t)LOOKS && seen.passed < (uint64_t)SPAN_MS * clock->unit_ms; ++i) {
    const uint64_t now = clock->now();
    const uint64_t step = difference(clock, last, now);

    if (is_back(clock, step)) {
      ++seen.backwards;
    } else if (step != 0u) {
      seen.passed += step;
      seen.smallest = step < seen.smallest ? step : seen.smallest;
      last = now;
    }
  }
  return seen;
}

bool selftest_clock(const selftest_clock_t * clock)
{
  const seen_t seen = look(clock);

  selftest_equal(clock->backwards, (int64_t)seen.backwards, 0, "steps back");
  if (seen.passed == 0u) {
    selftest_true(clock->resolution, false, "a clock that stands still", "one that advances");
  } else {
    selftest_at_most(
      clock->resolution, (int64_t)(seen.smallest / clock->unit_ms), (int64_t)LARGEST_STEP_MS,
      "ms in one step");
  }
  return seen.passed != 0u;
}

/* What delays this task between two readings only makes the difference larger: the smallest of some counts. */
void selftest_clock_agrees(const selftest_clock_t * clock)
{
  int64_t smallest = INT64_MAX;

  for (int i = 0; i < (int)TRIES; ++i) {
    const uint32_t start_ms = port_time_ms();
    const uint64_t start = clock->now();
    int64_t apart;

    port_sleep_ms((uint32_t)SLEEP_MS);
    apart = (int64_t)(difference(clock, start, clock->now()) / clock->unit_ms) -
            (int64_t)(port_time_ms() - start_ms);
    apart = apart < 0 ? -apart : apart;
    smallest = apart < smallest ? apart : smallest;
  }
  selftest_at_most(
    clock->agrees, smallest, (int64_t)LARGEST_STEP_MS, "ms apart from port_time_ms after 50 ms");
}
