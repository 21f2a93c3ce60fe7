/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_clock.h"
#include "selftest_config.h"
#include "selftest_pool.h"
#include "selftest_report.h"

enum {
  LONG_MS = 800,
  SET_AFTER_MS = 300,
  WOKEN_MS = 250,
  SHORT_MS = 10,
  MORE_MS = 20,
  REST_MS = 40,
  RETURNS = 200,
  TRIES = 3
};
enum { LIVES = 3, TURNS_MS = 450 };
enum { RELEASES = 40, HALF = 20, PERIOD_US = 5000, LATE_US = 10000, GROWTH_US = 1000, US_PER_MS = 1000 };

/* Written by the task, read when it was joined. */
static struct {
  int64_t late_us[RELEASES];
  uint32_t kept_ms;
  uint32_t set_ms;
  uint32_t short_ms;
  uint32_t returns;
  uint32_t past_ms;
  uint8_t self;
} seen;

/* Of the tasks of check_restart, read when they were joined; the first two belong to the one that is made several times. */
static struct {
  uint32_t lives;
  uint8_t self;
  uint32_t passed_ms;
} restart;

static uint64_t now_us(void)
{
  return port_task_time_us();
}

static uint32_t waited_ms(uint8_t task, uint32_t timeout_ms)
{
  const uint32_t start_ms = port_time_ms();

  port_task_wait(task, timeout_ms);
  return port_time_ms() - start_ms;
}

/* What delays a single wait does not count: the shortest of some. */
static uint32_t shortest_wait_ms(uint8_t task)
{
  uint32_t shortest = UINT32_MAX;

  for (int i = 0; i < (int)TRIES; ++i) {
    const uint32_t passed = waited_ms(task, (uint32_t)SHORT_MS);

    shortest = passed < shortest ? passed : shortest;
  }
  return shortest;
}

static uint32_t returns_while_idle(uint8_t task)
{
  const uint32_t start_ms = port_time_ms();
  uint32_t count = 0;

  while (port_time_ms() - start_ms < (uint32_t)REST_MS && count <= (uint32_t)RETURNS) {
    port_task_wait(task, (uint32_t)SHORT_MS);
    ++count;
  }
  return count;
}

/* The event was set before the first wait; another task sets it during the second one. */
static void events(uint8_t task)
{
  port_sleep_ms((uint32_t)SHORT_MS);
  seen.self = port_task_self();
  seen.kept_ms = waited_ms(task, (uint32_t)LONG_MS);
  seen.set_ms = waited_ms(task, (uint32_t)LONG_MS);
  seen.short_ms = shortest_wait_ms(task);
  seen.returns = returns_while_idle(task);
}

/* Waits to be looked at from outside. */
static void stands(uint8_t task)
{
  port_task_wait(task, (uint32_t)LONG_MS);
}

static void releases(uint8_t task)
{
  uint32_t due_us = port_task_time_us();
  uint32_t start_ms;

  (void)task;
  for (uint32_t i = 0; i < (uint32_t)RELEASES; ++i) {
    due_us += (uint32_t)PERIOD_US;
    port_task_sleep_until(due_us);
    seen.late_us[i] = (int64_t)(int32_t)(port_task_time_us() - due_us);
  }
  start_ms = port_time_ms();
  port_task_sleep_until(due_us - (uint32_t)PERIOD_US);
  port_task_sleep_until(due_us);
  seen.past_ms = port_time_ms() - start_ms;
}

static void check_events(void)
{
  if (!selftest_start(SELFTEST_LOW, events)) {
    return;
  }
  port_task_set(SELFTEST_LOW);
  port_sleep_ms((uint32_t)SET_AFTER_MS); /* without the first one, the first wait takes that long */
  port_task_set(SELFTEST_LOW);
  port_task_join(SELFTEST_LOW);
  selftest_equal("task_self", (int64_t)seen.self, (int64_t)SELFTEST_LOW, "in the task");
  selftest_equal(
    "task_self_outside", (int64_t)port_task_self(), (int64_t)PORT_TASK_NONE, "outside of the tasks");
  selftest_at_most("task_event_is_kept", (int64_t)seen.kept_ms, (int64_t)WOKEN_MS, "ms");
  selftest_at_most("task_event_wakes", (int64_t)seen.set_ms, (int64_t)SET_AFTER_MS + (int64_t)WOKEN_MS, "ms");
  selftest_at_most(
    "task_wait_upper_bound", (int64_t)seen.short_ms, (int64_t)SHORT_MS + (int64_t)MORE_MS, "ms");
  selftest_at_most("task_wait_rests", (int64_t)seen.returns, (int64_t)RETURNS, "returns within 40 ms");
}

/* A port may forget the mark when the task is joined. */
static void check_stack(void)
{
  uint32_t peak;

  if (!selftest_start(SELFTEST_LOW, stands)) {
    return;
  }
  port_sleep_ms((uint32_t)SHORT_MS * 2u);
  peak = port_task_stack_peak(SELFTEST_LOW);
  port_task_set(SELFTEST_LOW);
  port_task_join(SELFTEST_LOW);
  selftest_at_least("task_stack_peak", (int64_t)peak, (int64_t)sizeof(void *), "bytes");
  selftest_at_most("task_stack_peak_fits", (int64_t)peak, (int64_t)SELFTEST_TASK_STACK - 1, "bytes");
}

static void lives(uint8_t task)
{
  restart.self = port_task_self();
  ++restart.lives;
  port_task_wait(task, (uint32_t)LONG_MS);
}

static void turns(uint8_t task)
{
  const uint32_t start_ms = port_time_ms();
  uint32_t due_us = port_task_time_us();

  (void)task;
  for (uint32_t i = 0; i < (uint32_t)RELEASES; ++i) {
    due_us += (uint32_t)PERIOD_US;
    port_task_sleep_until(due_us);
  }
  restart.passed_ms = port_time_ms() - start_ms;
}

/* A task ends and is made again while another one continues. */
static void check_restart(void)
{
  bool is_made = true;

  if (!selftest_start(SELFTEST_MIDDLE, turns)) {
    return;
  }
  for (int i = 0; i < (int)LIVES && is_made; ++i) {
    is_made = selftest_start(SELFTEST_LOW, lives);
    if (is_made) {
      port_task_set(SELFTEST_LOW);
      port_task_join(SELFTEST_LOW);
    }
  }
  port_task_join(SELFTEST_MIDDLE);
  selftest_equal("task_restart", (int64_t)restart.lives, (int64_t)LIVES, "lives of a task");
  selftest_equal("task_restart_self", (int64_t)restart.self, (int64_t)SELFTEST_LOW, "in the task");
  selftest_at_most("task_restart_others", (int64_t)restart.passed_ms, (int64_t)TURNS_MS, "ms for 40 releases");
}

static int64_t least_late_us(uint32_t first)
{
  int64_t least = INT64_MAX;

  for (uint32_t i = first; i < first + (uint32_t)HALF; ++i) {
    least = seen.late_us[i] < least ? seen.late_us[i] : least;
  }
  return least;
}

static void check_releases(void)
{
  int64_t first;
  int64_t second;
  int64_t growth;

  if (!selftest_start(SELFTEST_MIDDLE, releases)) {
    return;
  }
  port_task_join(SELFTEST_MIDDLE);
  first = least_late_us(0);
  second = least_late_us((uint32_t)HALF);
  growth = second < first ? first - second : second - first;
  selftest_at_least("release_not_early", first < second ? first : second, 0, "us after it was due");
  selftest_at_most("release_not_late", first, (int64_t)LATE_US, "us after it was due");
  selftest_at_most("release_no_drift", growth, (int64_t)GROWTH_US, "us of drift in 20 periods");
  selftest_at_most("release_in_the_past", (int64_t)seen.past_ms, (int64_t)WOKEN_MS, "ms");
}

void selftest_tasks(void)
{
  static const selftest_clock_t clock = {
    now_us,
    UINT64_C(1) << 32,
    (uint32_t)US_PER_MS,
    "task_time_never_backwards",
    "task_time_resolution",
    "task_time_agrees"};

  (void)selftest_clock(&clock);
  selftest_clock_agrees(&clock);
  check_events();
  check_stack();
  check_restart();
  check_releases();
}
