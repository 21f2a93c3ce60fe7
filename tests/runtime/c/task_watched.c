/* SPDX-License-Identifier: Apache-2.0 */
/* When the watchdog of tasks is fed, with a clock that the test sets and that wraps. The application file is that of
 * test_tasks_watchdog.py: a margin of 2 ms. */
#include "unit.h"

#include <microros/lock.h>
#include <microros/port_tasks.h>
#include <microros/rclc_tasks_watch.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

enum { MARGIN = 2000, PERIOD = 1000, DEADLINE = 3000, HALF_A_SECOND = 500000 };

static uint32_t clock_us = UINT32_MAX - 1500u;
static uint32_t feeds;

void port_watchdog_feed(void)
{
  ++feeds;
}

bool port_task_create(uint8_t task, const port_task_t * setting)
{
  return task < (uint8_t)MICROROS_TASKS && setting->entry != NULL;
}

void port_task_join(uint8_t task)
{
  (void)task;
}

uint8_t port_task_self(void)
{
  return PORT_TASK_NONE;
}

bool port_task_has_priorities(void)
{
  return false;
}

bool port_task_set_priority(uint8_t task, uint8_t priority)
{
  (void)task;
  (void)priority;
  return false;
}

void port_task_set(uint8_t task)
{
  (void)task;
}

void port_task_wait(uint8_t task, uint32_t timeout_ms)
{
  (void)task;
  (void)timeout_ms;
}

uint32_t port_task_time_us(void)
{
  return clock_us;
}

uint32_t port_task_first_release_us(void)
{
  return clock_us;
}

void port_task_sleep_until(uint32_t time_us)
{
  (void)time_us;
}

uint32_t port_task_stack_peak(uint8_t task)
{
  (void)task;
  return 0;
}

/* Returns whether the watchdog was fed since the last call. */
static bool was_fed(void)
{
  const bool result = feeds != 0u;

  feeds = 0;
  return result;
}

static void release(uint8_t task)
{
  microros_lock();
  rclc_tasks_watch_release(task, clock_us);
  microros_unlock();
}

static void test_releases_over_the_wrap(void)
{
  for (uint32_t i = 0; i < 6u; ++i) {
    clock_us += PERIOD;
    rclc_tasks_watch_period(RCLC_TASK_CONTROL, clock_us);
    CHECK(was_fed());
  }
  CHECK(clock_us < 10000u);    /* it has wrapped */
  clock_us += PERIOD + MARGIN; /* the deadline is the period */
  rclc_tasks_watch_rest(RCLC_TASK_SESSION);
  CHECK(was_fed());
  ++clock_us;
  rclc_tasks_watch_rest(RCLC_TASK_SESSION);
  CHECK(!was_fed());
  rclc_tasks_watch_period(RCLC_TASK_CONTROL, clock_us + 1000000000u);
  CHECK(!was_fed()); /* this run was late */
  rclc_tasks_watch_rest(RCLC_TASK_SESSION);
  CHECK(was_fed()); /* the next release is long to come */
}

/* Two rounds of the clock. */
static void test_a_task_that_stays_away(void)
{
  rclc_tasks_watch_period(RCLC_TASK_CONTROL, clock_us);
  (void)was_fed();
  for (uint32_t i = 0; i < 17200u; ++i) {
    clock_us += HALF_A_SECOND;
    rclc_tasks_watch_rest(RCLC_TASK_WORKER);
    rclc_tasks_watch_rest(RCLC_TASK_SESSION);
    CHECK(!was_fed());
  }
  rclc_tasks_watch_period(RCLC_TASK_CONTROL, clock_us + 1000000000u);
  rclc_tasks_watch_rest(RCLC_TASK_SESSION);
  CHECK(was_fed());
}

static void test_a_task_of_events(void)
{
  clock_us += 1000000u + MARGIN; /* the longest wait: nothing has released it */
  rclc_tasks_watch_rest(RCLC_TASK_SESSION);
  CHECK(was_fed());
  rclc_tasks_watch_rest(RCLC_TASK_WORKER);
  release(RCLC_TASK_WORKER);
  clock_us += DEADLINE + MARGIN;
  rclc_tasks_watch_rest(RCLC_TASK_SESSION);
  CHECK(was_fed());
  ++clock_us;
  rclc_tasks_watch_rest(RCLC_TASK_SESSION);
  release(RCLC_TASK_WORKER); /* by another task: it says nothing of this one */
  rclc_tasks_watch_rest(RCLC_TASK_SESSION);
  CHECK(!was_fed());
  rclc_tasks_watch_rest(RCLC_TASK_WORKER);
  CHECK(!was_fed());
  rclc_tasks_watch_rest(RCLC_TASK_WORKER);
  CHECK(was_fed());
}

/* Without a deadline a run of the session may take as long as the margin. */
static void test_the_session(void)
{
  rclc_tasks_watch_run(RCLC_TASK_SESSION);
  CHECK(was_fed());
  clock_us += MARGIN;
  rclc_tasks_watch_rest(RCLC_TASK_WORKER);
  CHECK(was_fed());
  ++clock_us;
  rclc_tasks_watch_rest(RCLC_TASK_WORKER);
  CHECK(!was_fed());
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rclc_executor_t executors[2];

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  for (uint8_t i = 0; i < 2u; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    CHECK(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
    CHECK(rclc_task_set_executor(i, &executors[i], NULL) == RCL_RET_OK);
  }
  CHECK(rclc_tasks_start() == RCL_RET_OK && !was_fed());
  test_releases_over_the_wrap();
  test_a_task_that_stays_away();
  test_a_task_of_events();
  test_the_session();
  CHECK(rclc_tasks_stop() == RCL_RET_OK && rclc_tasks_start() == RCL_RET_OK);
  rclc_tasks_watch_rest(RCLC_TASK_WORKER);
  CHECK(was_fed()); /* what was late before the start counts no more */
  return 0;
}
