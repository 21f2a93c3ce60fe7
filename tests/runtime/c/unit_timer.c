/* SPDX-License-Identifier: Apache-2.0 */
/* Timers: three places, on a steady clock and on ROS time. */
#include "port_agent.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>

#include <string.h>

static const int64_t ms = 1000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static int calls;
static int64_t since;
static size_t resets;

static void on_timer(rcl_timer_t * timer, int64_t last_call_time)
{
  CHECK(timer != NULL);
  ++calls;
  since = last_call_time;
}

static void on_reset(const void * user_data, size_t count)
{
  CHECK(user_data == &resets);
  resets += count;
}

static rcl_timer_t timer_on(rcl_clock_t * clock, int64_t period)
{
  rcl_timer_t timer = rcl_get_zero_initialized_timer();

  CHECK(rcl_timer_init(&timer, clock, &support.context, period, on_timer, allocator) == RCL_RET_OK);
  return timer;
}

static int64_t until(const rcl_timer_t * timer)
{
  int64_t time = 0;

  CHECK(rcl_timer_get_time_until_next_call(timer, &time) == RCL_RET_OK);
  return time;
}

static bool ready(const rcl_timer_t * timer)
{
  bool is_ready = false;

  CHECK(rcl_timer_is_ready(timer, &is_ready) == RCL_RET_OK);
  return is_ready;
}

static void test_arguments(void)
{
  rcl_context_t closed = rcl_get_zero_initialized_context();
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  int64_t number;
  bool flag;

  CHECK(
    rcl_timer_init2(NULL, &support.clock, &support.context, 1, NULL, allocator, true) ==
    RCL_RET_INVALID_ARGUMENT);
  CHECK(
    rcl_timer_init2(&timer, NULL, &support.context, 1, NULL, allocator, true) == RCL_RET_INVALID_ARGUMENT);
  CHECK(
    rcl_timer_init2(&timer, &support.clock, &support.context, -1, NULL, allocator, true) ==
    RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_timer_init2(&timer, &support.clock, &closed, 1, NULL, allocator, true) == RCL_RET_NOT_INIT);
  CHECK(rclc_timer_init_default2(&timer, NULL, 1, NULL, true) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_timer_call(NULL) == RCL_RET_INVALID_ARGUMENT && rcl_timer_call(&timer) == RCL_RET_TIMER_INVALID);
  CHECK(
    rcl_timer_cancel(&timer) == RCL_RET_TIMER_INVALID && rcl_timer_reset(&timer) == RCL_RET_TIMER_INVALID);
  CHECK(rcl_timer_is_ready(&timer, &flag) == RCL_RET_TIMER_INVALID);
  CHECK(rcl_timer_get_period(&timer, &number) == RCL_RET_TIMER_INVALID);
  CHECK(rcl_timer_get_callback(&timer) == NULL && rcl_timer_get_allocator(&timer) == NULL);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK && rcl_timer_fini(NULL) == RCL_RET_OK);
  timer = timer_on(&support.clock, 5);
  CHECK(rcl_timer_init(&timer, &support.clock, &support.context, 1, NULL, allocator) == RCL_RET_ALREADY_INIT);
  CHECK(rcl_timer_is_ready(&timer, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
}

static void test_pool(void)
{
  rcl_timer_t timers[3];
  rcl_timer_t other = rcl_get_zero_initialized_timer();

  for (size_t i = 0; i < 3u; ++i) {
    timers[i] = timer_on(&support.clock, 5);
  }
  CHECK(rcl_timer_init(&other, &support.clock, &support.context, 1, NULL, allocator) == RCL_RET_BAD_ALLOC);
  CHECK(
    strcmp(
      rcl_get_error_string().str, "all 3 timers are in use: set pools: {timers: 4} in microros.yaml") ==
    0);
  CHECK(rcl_timer_fini(&timers[1]) == RCL_RET_OK);
  other = timer_on(&support.clock, 5);
  CHECK(rcl_timer_fini(&other) == RCL_RET_OK && rcl_timer_fini(&timers[0]) == RCL_RET_OK);
  CHECK(rcl_timer_fini(&timers[2]) == RCL_RET_OK);
}

/* 10 ms, called late: what was missed is left out, and the grid stays. */
static void test_periods(void)
{
  rcl_timer_t timer = timer_on(&support.clock, 10 * ms);
  const int64_t start = agent_now_ns;
  rcl_timer_call_info_t info;

  CHECK(until(&timer) == 10 * ms && !ready(&timer));
  agent_now_ns = start + 10 * ms;
  CHECK(ready(&timer));
  agent_now_ns = start + 13 * ms;
  calls = 0;
  CHECK(rcl_timer_call_with_info(&timer, &info) == RCL_RET_OK && calls == 1 && since == 13 * ms);
  CHECK(info.expected_call_time == start + 10 * ms && info.actual_call_time == start + 13 * ms);
  CHECK(until(&timer) == 7 * ms);
  agent_now_ns = start + 59 * ms;
  CHECK(until(&timer) == -39 * ms);
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && calls == 2 && since == 46 * ms);
  CHECK(until(&timer) == 1 * ms); /* 60 */
  agent_now_ns = start + 70 * ms; /* due at 60; the next one, 70, counts as missed */
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && until(&timer) == 10 * ms);
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && until(&timer) == 20 * ms); /* before its time */
  CHECK(rcl_timer_get_time_since_last_call(&timer, &since) == RCL_RET_OK && since == 0);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
}

/* Every distance from no missed period to many: the next call is the first one on the grid that is later than now. */
static void test_missed_periods(void)
{
  static const int64_t periods[] = {1, 3, 1000, 10000000, 999999937, INT64_C(86400000000000), INT64_MAX / 8};
  static const int64_t factors[] = {0, 1, 2, 3, 1000, 123456789, INT64_C(1000000000000)};
  const int64_t kept_ns = agent_now_ns;

  for (size_t i = 0; i < sizeof(periods) / sizeof(periods[0]); ++i) {
    for (size_t k = 0; k < sizeof(factors) / sizeof(factors[0]); ++k) {
      for (int64_t off = -1; off <= 1 && factors[k] < INT64_MAX / 4 / periods[i]; ++off) {
        rcl_timer_t timer = timer_on(&support.clock, periods[i]);
        const int64_t due = agent_now_ns + periods[i];
        int64_t next = due + periods[i];

        agent_now_ns = due + factors[k] * periods[i] + off;
        if (next <= agent_now_ns) {
          next += (1 + (agent_now_ns - next) / periods[i]) * periods[i];
        }
        CHECK(rcl_timer_call(&timer) == RCL_RET_OK && until(&timer) == next - agent_now_ns);
        CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
        agent_now_ns = kept_ns;
      }
    }
  }
}

static bool triggered(rcl_guard_condition_t * guard)
{
  rcl_wait_set_t set = rcl_get_zero_initialized_wait_set();
  rcl_ret_t result;

  CHECK(rcl_wait_set_init(&set, 0, 1, 0, 0, 0, 0, &support.context, allocator) == RCL_RET_OK);
  CHECK(rcl_wait_set_add_guard_condition(&set, guard, NULL) == RCL_RET_OK);
  result = rcl_wait(&set, 0);
  CHECK(result == RCL_RET_OK || result == RCL_RET_TIMEOUT);
  CHECK(rcl_wait_set_fini(&set) == RCL_RET_OK);
  return result == RCL_RET_OK;
}

/* Resets trigger it, those before it was asked for too; and jumps that make the timer ready. */
static void test_guard_condition(void)
{
  rcl_clock_t clock;
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  rcl_guard_condition_t * guard;

  CHECK(rcl_timer_get_guard_condition(NULL) == NULL && rcl_timer_get_guard_condition(&timer) == NULL);
  CHECK(rcl_ros_clock_init(&clock, &allocator) == RCL_RET_OK);
  timer = timer_on(&clock, 10 * ms);
  CHECK(rcl_timer_reset(&timer) == RCL_RET_OK);
  guard = rcl_timer_get_guard_condition(&timer);
  CHECK(guard != NULL && triggered(guard) && !triggered(guard));
  CHECK(rcl_timer_get_guard_condition(&timer) == guard && !triggered(guard));
  CHECK(rcl_timer_reset(&timer) == RCL_RET_OK && rcl_timer_reset(&timer) == RCL_RET_OK);
  CHECK(triggered(guard) && !triggered(guard));
  CHECK(
    rcl_set_ros_time_override(&clock, 100 * ms) == RCL_RET_OK &&
    rcl_enable_ros_time_override(&clock) == RCL_RET_OK);
  CHECK(rcl_timer_reset(&timer) == RCL_RET_OK && triggered(guard));
  CHECK(rcl_set_ros_time_override(&clock, 109 * ms) == RCL_RET_OK && !triggered(guard));
  CHECK(rcl_set_ros_time_override(&clock, 110 * ms) == RCL_RET_OK && triggered(guard));
  CHECK(rcl_set_ros_time_override(&clock, 50 * ms) == RCL_RET_OK && !triggered(guard));
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK && rcl_timer_get_guard_condition(&timer) == NULL);
  timer = timer_on(&clock, 10 * ms); /* in the same place */
  guard = rcl_timer_get_guard_condition(&timer);
  CHECK(guard != NULL && !triggered(guard));
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK && rcl_clock_fini(&clock) == RCL_RET_OK);
}

static void test_exchanges(void)
{
  rcl_timer_t timer = timer_on(&support.clock, 10 * ms);
  rcl_clock_t * clock = NULL;
  int64_t old = 0;

  CHECK(rcl_timer_clock(&timer, &clock) == RCL_RET_OK && clock == &support.clock);
  CHECK(rcl_timer_exchange_period(&timer, 4 * ms, &old) == RCL_RET_OK && old == 10 * ms);
  CHECK(rcl_timer_get_period(&timer, &old) == RCL_RET_OK && old == 4 * ms && until(&timer) == 10 * ms);
  agent_now_ns += 10 * ms;
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && until(&timer) == 4 * ms);
  CHECK(rcl_timer_get_callback(&timer) == on_timer);
  CHECK(rcl_timer_exchange_callback(&timer, NULL) == on_timer && rcl_timer_get_callback(&timer) == NULL);
  calls = 0;
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && calls == 0);
  CHECK(rcl_timer_get_allocator(&timer) != NULL);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
  timer = timer_on(&support.clock, 0); /* always ready */
  CHECK(ready(&timer) && rcl_timer_call(&timer) == RCL_RET_OK && ready(&timer));
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
}

static void test_cancel(void)
{
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  bool is_canceled = false;
  int64_t time;

  CHECK(rclc_timer_init_default2(&timer, &support, 10000000u, on_timer, false) == RCL_RET_OK);
  CHECK(rcl_timer_is_canceled(&timer, &is_canceled) == RCL_RET_OK && is_canceled);
  agent_now_ns += 30 * ms;
  CHECK(!ready(&timer) && rcl_timer_call(&timer) == RCL_RET_TIMER_CANCELED);
  CHECK(rcl_timer_get_time_until_next_call(&timer, &time) == RCL_RET_TIMER_CANCELED);
  CHECK(rcl_timer_reset(&timer) == RCL_RET_OK && until(&timer) == 10 * ms);
  CHECK(rcl_timer_reset(&timer) == RCL_RET_OK);
  CHECK(rcl_timer_set_on_reset_callback(&timer, on_reset, &resets) == RCL_RET_OK && resets == 2u);
  CHECK(rcl_timer_reset(&timer) == RCL_RET_OK && resets == 3u);
  CHECK(rcl_timer_cancel(&timer) == RCL_RET_OK && !ready(&timer));
  CHECK(rcl_timer_set_on_reset_callback(&timer, NULL, NULL) == RCL_RET_OK);
  CHECK(rcl_timer_reset(&timer) == RCL_RET_OK && resets == 3u);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK);
}

/* ROS time stops, runs, and jumps both ways. */
static void test_ros_time(void)
{
  rcl_clock_t clock;
  rcl_timer_t timer;

  agent_epoch_ns = 1000 * ms;
  CHECK(rcl_clock_init(RCL_ROS_TIME, &clock, &allocator) == RCL_RET_OK);
  timer = timer_on(&clock, 50 * ms);
  agent_epoch_ns += 20 * ms;
  CHECK(until(&timer) == 30 * ms);
  CHECK(rcl_set_ros_time_override(&clock, 7 * ms) == RCL_RET_OK);
  CHECK(rcl_enable_ros_time_override(&clock) == RCL_RET_OK);
  CHECK(until(&timer) == 20 * ms); /* 30 ms were left: so many are over in the new time, says Jazzy */
  agent_epoch_ns += 500 * ms;
  agent_now_ns += 500 * ms;
  CHECK(until(&timer) == 20 * ms); /* it stands still */
  CHECK(rcl_set_ros_time_override(&clock, 17 * ms) == RCL_RET_OK && until(&timer) == 10 * ms);
  CHECK(rcl_set_ros_time_override(&clock, 200 * ms) == RCL_RET_OK && ready(&timer));
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && until(&timer) == 27 * ms); /* due at 27, 77, 127, 177, 227 */
  CHECK(
    rcl_set_ros_time_override(&clock, 100 * ms) == RCL_RET_OK &&
    until(&timer) == 50 * ms); /* before the call */
  CHECK(rcl_set_ros_time_override(&clock, 120 * ms) == RCL_RET_OK && until(&timer) == 30 * ms);
  CHECK(
    rcl_set_ros_time_override(&clock, 110 * ms) == RCL_RET_OK &&
    until(&timer) == 40 * ms); /* back a little */
  CHECK(rcl_disable_ros_time_override(&clock) == RCL_RET_OK && until(&timer) == 10 * ms);
  CHECK(rcl_set_ros_time_override(&clock, 0) == RCL_RET_OK);
  CHECK(
    rcl_enable_ros_time_override(&clock) == RCL_RET_OK); /* without a time there is nothing to carry over */
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK && rcl_clock_fini(&clock) == RCL_RET_OK);
}

/* Times and periods at the ends of 64 bits: nothing overflows (the unit is built with sanitizers), nothing hangs. */
static void test_the_ends_of_time(void)
{
  rcl_clock_t clock;
  rcl_timer_t timer;
  rcl_timer_t longest = timer_on(&support.clock, INT64_MAX);
  int64_t time = 0;

  CHECK(until(&longest) == INT64_MAX - agent_now_ns && rcl_timer_call(&longest) == RCL_RET_OK);
  CHECK(until(&longest) == INT64_MAX - agent_now_ns && rcl_timer_reset(&longest) == RCL_RET_OK);
  CHECK(rcl_timer_fini(&longest) == RCL_RET_OK);
  CHECK(rcl_clock_init(RCL_ROS_TIME, &clock, &allocator) == RCL_RET_OK);
  CHECK(rcl_set_ros_time_override(&clock, INT64_MAX - 5) == RCL_RET_OK);
  CHECK(rcl_enable_ros_time_override(&clock) == RCL_RET_OK);
  timer = timer_on(&clock, 10);
  CHECK(until(&timer) == 5 && !ready(&timer));
  CHECK(rcl_set_ros_time_override(&clock, INT64_MAX) == RCL_RET_OK && ready(&timer));
  calls = 0;
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && calls == 1 && since == 5 && until(&timer) == 0);
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && calls == 2 && rcl_timer_reset(&timer) == RCL_RET_OK);
  CHECK(rcl_set_ros_time_override(&clock, INT64_MIN) == RCL_RET_OK);
  CHECK(rcl_timer_get_time_since_last_call(&timer, &time) == RCL_RET_OK && time == 0);
  CHECK(until(&timer) == 10 && rcl_timer_call(&timer) == RCL_RET_ERROR);
  CHECK(rcl_set_ros_time_override(&clock, INT64_MAX) == RCL_RET_OK && ready(&timer));
  CHECK(rcl_timer_call(&timer) == RCL_RET_OK && since == INT64_MAX && until(&timer) == 0);
  CHECK(rcl_disable_ros_time_override(&clock) == RCL_RET_OK);
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK && rcl_clock_fini(&clock) == RCL_RET_OK);
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(support.clock.type == RCL_STEADY_TIME);
  test_arguments();
  test_pool();
  test_periods();
  test_missed_periods();
  test_guard_condition();
  test_exchanges();
  test_cancel();
  test_ros_time();
  test_the_ends_of_time();
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
  return 0;
}
