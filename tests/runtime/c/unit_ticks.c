/* SPDX-License-Identifier: Apache-2.0 */
/* Timers with a kind: 0 rtos 10 ms, 1 hardware 20 ms, 2 clock 30 ms. */
#include "port_agent.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

static const int64_t ms = 1000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static int calls[3];
static rcl_timer_t timers[3];

static void on_timer(rcl_timer_t * timer, int64_t last_call_time)
{
  (void)last_call_time;
  ++calls[timer - timers];
}

static void tick_rtos(void)
{
  agent_ticks[0](0);
}

static void start(size_t i, int64_t period)
{
  CHECK(rclc_timer_init_default2(&timers[i], &support, (uint64_t)period, on_timer, true) == RCL_RET_OK);
}

static void test_kinds_by_period(void)
{
  start(1, 20 * ms); /* in another order than declared */
  start(0, 10 * ms);
  start(2, 77 * ms); /* not declared: what a clock drives */
  CHECK(agent_ticks[0] != NULL && agent_periods[0] == 10 * ms);
  CHECK(agent_ticks[1] != NULL && agent_periods[1] == 20 * ms && agent_ticks[2] == NULL);
}

static void test_a_tick_is_a_call(rclc_executor_t * executor)
{
  const int64_t begin = agent_now_ns;
  bool is_ready = true;

  for (size_t i = 0; i < 3u; ++i) {
    CHECK(rclc_executor_add_timer(executor, &timers[i]) == RCL_RET_OK);
  }
  agent_event_ns = begin + 15 * ms;
  agent_event = tick_rtos;
  CHECK(rclc_executor_spin_some(executor, 1000000000u) == RCL_RET_OK);
  CHECK(calls[0] == 1 && calls[1] == 0 && agent_now_ns == begin + 15 * ms); /* the tick, not the clock */
  CHECK(rcl_timer_is_ready(&timers[0], &is_ready) == RCL_RET_OK && !is_ready);
  agent_ticks[1](1);
  CHECK(rcl_timer_is_ready(&timers[1], &is_ready) == RCL_RET_OK && is_ready);
  CHECK(rclc_executor_spin_some(executor, 0) == RCL_RET_OK && calls[1] == 1);
  CHECK(rclc_executor_spin_some(executor, (uint64_t)(100 * ms)) == RCL_RET_OK);
  CHECK(calls[2] == 1 && agent_now_ns == begin + 77 * ms); /* by its clock */
}

static void test_stops_and_starts(void)
{
  int64_t old;
  bool is_ready = true;

  agent_ticks[0](0);
  CHECK(rcl_timer_cancel(&timers[0]) == RCL_RET_OK && agent_ticks[0] == NULL);
  CHECK(rcl_timer_reset(&timers[0]) == RCL_RET_OK && agent_ticks[0] != NULL);
  CHECK(
    rcl_timer_is_ready(&timers[0], &is_ready) == RCL_RET_OK &&
    !is_ready); /* a tick of before does not count */
  CHECK(rcl_timer_exchange_period(&timers[0], 5 * ms, &old) == RCL_RET_OK && agent_periods[0] == 10 * ms);
  CHECK(rcl_timer_call(&timers[0]) == RCL_RET_OK && agent_periods[0] == 5 * ms);
  CHECK(rcl_timer_fini(&timers[0]) == RCL_RET_OK && agent_ticks[0] == NULL);
  CHECK(rcl_timer_fini(&timers[1]) == RCL_RET_OK && agent_ticks[1] == NULL);
  CHECK(rcl_timer_fini(&timers[2]) == RCL_RET_OK);
}

int main(void)
{
  rclc_executor_t executor;

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 3, &allocator) == RCL_RET_OK);
  test_kinds_by_period();
  test_a_tick_is_a_call(&executor);
  test_stops_and_starts();
  return 0;
}
