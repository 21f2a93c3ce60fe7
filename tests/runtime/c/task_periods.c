/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Releases of tasks with a period on a port whose clock the test sets: it wraps after two releases, each sleep ends a
 * little late, and one run takes two and a half periods. The application file is that of test_tasks.py.
 */
#include "unit.h"

#include <microros/port_tasks.h>
#include <microros/rcl_tasks.h>
#include <microros/rclc_tasks.h>
#include <microros/rclc_tasks_state.h>
#include <microros/rmw_tasks.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <string.h>

enum {
  PERIOD = 1000,
  RUNS = 12,
  LONG_RUN = 3,
  LONG = 2500,
  LATE_RUN = 8,
  LATE = 700,
  DEADLINE = 300,
  SHORT = 100,
  REFUSED_LEVEL = 2
};

static const uint32_t start = UINT32_MAX - 2500u;

static uint32_t clock_us;
static uint32_t sleeps;
static uint8_t self = PORT_TASK_NONE;
static uint32_t began[RUNS];
static uint32_t runs;
static uint32_t told;
static uint32_t told_times;
static uint32_t made;
static bool stops_in_sleep;
static bool restarts;
static uint32_t waits;
static bool is_joining;
static uint8_t changed_task;
static uint8_t changed_level;

bool port_task_create(uint8_t task, const port_task_t * setting)
{
  CHECK(setting == &rclc_task_settings[task] && setting->stack_size % 8u == 0u);
  CHECK(task == (restarts ? (uint8_t)RCLC_TASK_CATCHES : made));
  made += restarts ? 0u : 1u;
  return true;
}

void port_task_join(uint8_t task)
{
  CHECK(task < made);
  is_joining = true;
  CHECK(rclc_task_stack_peak(task) == task + 1u); /* the port is not asked meanwhile */
  is_joining = false;
}

uint8_t port_task_self(void)
{
  return self;
}

bool port_task_has_priorities(void)
{
  return false;
}

bool port_task_set_priority(uint8_t task, uint8_t priority)
{
  changed_task = task;
  changed_level = priority;
  return priority != (uint8_t)REFUSED_LEVEL;
}

void port_task_set(uint8_t task)
{
  CHECK(task < made);
}

void port_task_wait(uint8_t task, uint32_t timeout_ms)
{
  (void)timeout_ms;
  ++waits;
  if (waits == 1u) {
    rmw_tasks_release(task, 5); /* for nothing */
  } else {
    CHECK(rmw_tasks_released(task, 7) == 7u);
    self = PORT_TASK_NONE;
    CHECK(rclc_tasks_stop() == RCL_RET_OK);
    self = task;
  }
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
  const uint32_t left_us = time_us - clock_us;

  if (left_us != 0u && left_us < 0x80000000u) {
    clock_us = time_us + sleeps % 7u; /* the system is up to 6 us late */
    ++sleeps;
  }
  if (stops_in_sleep) {
    self = PORT_TASK_NONE;
    CHECK(rclc_tasks_stop() == RCL_RET_OK);
  }
}

uint32_t port_task_stack_peak(uint8_t task)
{
  CHECK(!is_joining);
  return task + 1u;
}

/* Another task stops this one in its run. */
static void stop_this_one(uint8_t task)
{
  self = PORT_TASK_NONE;
  CHECK(rclc_task_stop(task) == RCL_RET_OK);
  self = task;
}

static void on_release(uint8_t task)
{
  CHECK(task == self);
  began[runs] = clock_us - start;
  clock_us += runs == (uint32_t)LONG_RUN ? LONG : (runs == (uint32_t)LATE_RUN ? LATE : SHORT);
  ++runs;
  if (restarts && (runs == (uint32_t)LONG_RUN || runs == (uint32_t)RUNS)) {
    stop_this_one(task);
  } else if (runs == (uint32_t)RUNS) {
    CHECK(rclc_tasks_stop() == RCL_RET_ERROR); /* a task cannot wait for itself */
    self = PORT_TASK_NONE;
    CHECK(rclc_tasks_stop() == RCL_RET_OK);
    self = task;
  }
}

static void on_overrun(uint8_t task, uint32_t missed)
{
  CHECK(task == self);
  told += missed;
  ++told_times;
}

/* Runs a task as the system would, and returns its counters. */
static rclc_task_counters_t run(uint8_t task)
{
  rclc_task_counters_t counters;

  runs = 0;
  sleeps = 0;
  made = 0;
  clock_us = start;
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  CHECK(made == (uint32_t)MICROROS_TASKS && rclc_tasks_start() == RCL_RET_ERROR);
  self = task;
  rclc_task_settings[task].entry(task);
  self = PORT_TASK_NONE;
  CHECK(rclc_task_get_counters(task, &counters) == RCL_RET_OK);
  CHECK(counters.runs == (uint32_t)RUNS && counters.failed == 0u);
  return counters;
}

/* The releases keep to multiples of the period: what is late at one of them does not move the next one. */
static void check_grid(uint32_t first, uint32_t run_index)
{
  for (uint32_t i = first; i < (uint32_t)RUNS; ++i) {
    const uint32_t release = (run_index + i - first) * (uint32_t)PERIOD;

    CHECK(began[i] >= release && began[i] - release < 7u);
  }
}

/* It is away for a hundred and a half periods: with `overrun: catch_up` those would all run now, if they were releases of
 * it. Its grid begins with the start. */
static void check_restart(void)
{
  const uint8_t task = RCLC_TASK_CATCHES;
  rclc_task_counters_t counters;
  uint32_t again_us;

  runs = 0;
  sleeps = 0;
  made = 0;
  clock_us = start;
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  restarts = true;
  self = task;
  rclc_task_settings[task].entry(task);
  CHECK(runs == (uint32_t)LONG_RUN);
  self = PORT_TASK_NONE;
  clock_us += 100u * (uint32_t)PERIOD + (uint32_t)PERIOD / 2u;
  again_us = clock_us - start;
  runs = (uint32_t)LONG_RUN + 1u; /* no long run */
  CHECK(rclc_task_start(task) == RCL_RET_OK);
  self = task;
  rclc_task_settings[task].entry(task);
  self = PORT_TASK_NONE;
  CHECK(runs == (uint32_t)RUNS);
  CHECK(rclc_task_get_counters(task, &counters) == RCL_RET_OK);
  CHECK(counters.runs == (uint32_t)RUNS - 1u && counters.missed == 0u && counters.overruns == 0u);
  CHECK(counters.latest_us < 7u);
  for (uint32_t i = (uint32_t)LONG_RUN + 1u; i < (uint32_t)RUNS; ++i) {
    CHECK(began[i] - again_us - (i - (uint32_t)LONG_RUN - 1u) * (uint32_t)PERIOD < 7u);
  }
  restarts = false;
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
}

/* A round of a task without a period is an overrun if it ends after the deadline. */
static void check_round(rclc_executor_t * executor, uint32_t us, bool is_late)
{
  const uint32_t before = told_times;

  rclc_tasks_round_begins(executor);
  clock_us += us;
  rclc_tasks_round_ends(executor);
  CHECK(told_times - before == (is_late ? 1u : 0u));
}

static void check_events(rclc_executor_t * executor)
{
  rclc_task_counters_t counters;

  made = 0;
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  self = RCLC_TASK_REACTS;
  told = 0;
  check_round(executor, DEADLINE, false);
  check_round(executor, (uint32_t)DEADLINE + 1u, true);
  CHECK(told == 0u);
  CHECK(rclc_task_get_counters(RCLC_TASK_REACTS, &counters) == RCL_RET_OK);
  CHECK(counters.runs == 2u && counters.overruns == 1u);
  self = PORT_TASK_NONE;
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rclc_executor_t executors[4];
  rclc_task_counters_t counters;

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  for (uint8_t i = 0; i < 4u; ++i) {
    executors[i] = rclc_executor_get_zero_initialized_executor();
    CHECK(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
    CHECK(rclc_tasks_start() == RCL_RET_ERROR); /* not every task has an executor */
    CHECK(rclc_task_set_executor(i, &executors[i], on_release) == RCL_RET_OK);
  }
  CHECK(rclc_task_set_executor(RCLC_TASK_SESSION, &executors[0], NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_tasks_start() == RCL_RET_ERROR); /* nor a function for its overruns */
  CHECK(rclc_task_set_overrun(RCLC_TASK_SKIPS, on_overrun) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_task_set_overrun(RCLC_TASK_TELLS, on_overrun) == RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_ERROR); /* one more has none */
  CHECK(rclc_task_set_overrun(RCLC_TASK_REACTS, on_overrun) == RCL_RET_OK);
  CHECK(rclc_tasks_stop() == RCL_RET_ERROR);

  /* 1 is the highest for the application, and the lowest for the port. */
  CHECK(
    rclc_task_set_priority(RCLC_TASK_TELLS, 1) == RCL_RET_ERROR && changed_level == 0u); /* they do not run */
  made = 0;
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  CHECK(rclc_task_set_priority(RCLC_TASK_TELLS, 1) == RCL_RET_OK);
  CHECK(changed_task == RCLC_TASK_TELLS && changed_level == (uint8_t)MICROROS_TASKS);
  CHECK(rclc_task_set_priority(RCLC_TASK_SESSION, MICROROS_TASKS) == RCL_RET_OK);
  CHECK(changed_task == RCLC_TASK_SESSION && changed_level == 1u);
  CHECK(
    rclc_task_set_priority(RCLC_TASK_SKIPS, MICROROS_TASKS - 1) == RCL_RET_ERROR); /* refused by the system */
  CHECK(rclc_task_set_priority(RCLC_TASK_SKIPS, 0) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_task_set_priority(RCLC_TASK_SKIPS, MICROROS_TASKS + 1) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_task_set_priority(MICROROS_TASKS, 1) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
  CHECK(rclc_task_set_priority(RCLC_TASK_TELLS, 1) == RCL_RET_ERROR);

  /* Run 3 takes from 3000 to 5500: the releases at 4000 and 5000 are left out. */
  counters = run(RCLC_TASK_SKIPS);
  CHECK(counters.missed == 2u && counters.overruns == 1u && counters.latest_us == 6u);
  CHECK(counters.longest_us == (uint32_t)LONG);
  check_grid(LONG_RUN + 1, 6);

  /* They follow at once: the one of 4000 at 5500, that of 5000 at 5600; that of 6000 comes in time. */
  counters = run(RCLC_TASK_CATCHES);
  CHECK(counters.missed == 0u && counters.overruns == 2u);
  CHECK(began[LONG_RUN + 1] == began[LONG_RUN] + (uint32_t)LONG);
  CHECK(began[LONG_RUN + 2] == began[LONG_RUN] + (uint32_t)LONG + (uint32_t)SHORT);
  check_grid(LONG_RUN + 3, 6);

  CHECK(told == 0u);
  counters = run(RCLC_TASK_TELLS);
  CHECK(
    counters.missed == 2u && told == 2u &&
    told_times == 2u); /* and the run that is late, but misses no release */
  CHECK(counters.overruns == 2u);
  check_grid(LONG_RUN + 1, 6);

  check_restart();
  check_events(&executors[3]);

  /* A release without a run is forgotten: by the task, and by the next start. */
  made = 0;
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  self = RCLC_TASK_CATCHES;
  rclc_tasks_run_events(RCLC_TASK_CATCHES);
  CHECK(waits == 2u);
  rmw_tasks_release(RCLC_TASK_CATCHES, 5);
  made = 0;
  self = PORT_TASK_NONE;
  rclc_task_states[RCLC_TASK_SESSION].counters.runs = 3; /* as if it had run */
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  CHECK(rclc_task_get_counters(RCLC_TASK_SESSION, &counters) == RCL_RET_OK && counters.runs == 0u);
  CHECK(rmw_tasks_released(RCLC_TASK_CATCHES, 7) == 7u);
  CHECK(rclc_tasks_stop() == RCL_RET_OK);

  stops_in_sleep = true;
  made = 0;
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  rclc_task_settings[RCLC_TASK_SKIPS].entry(RCLC_TASK_SKIPS);
  CHECK(rclc_task_get_counters(RCLC_TASK_SKIPS, &counters) == RCL_RET_OK && counters.runs == 0u);

  CHECK(rcl_tasks_missed() == 4u && rcl_tasks_overruns() == 6u); /* of all tasks */
  CHECK(rclc_task_stack_peak(RCLC_TASK_TELLS) == 3u && rclc_task_stack_peak(MICROROS_TASKS) == 0u);
  CHECK(rclc_task_stack_size(MICROROS_TASKS) == 0u && !rclc_tasks_are_prioritized());
  CHECK(rclc_task_get_counters(MICROROS_TASKS, &counters) == RCL_RET_INVALID_ARGUMENT);
  return 0;
}
