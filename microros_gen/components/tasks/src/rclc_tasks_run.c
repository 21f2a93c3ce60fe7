/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/executor_handles.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rcl_tasks.h"
#include "microros/rcl_waiting.h"
#include "microros/rclc_tasks.h"
#include "microros/rclc_tasks_state.h"
#include "microros/rclc_tasks_watch.h"
#include "microros/rmw_client.h"
#include "microros/rmw_client_wait.h"
#include "microros/rmw_tasks.h"
#include "microros/wake.h"
#include "microros/xrce_client.h"
#include "microros/xrce_turn.h"

#include <stddef.h>

rclc_task_state_t rclc_task_states[MICROROS_TASKS];

/* A round may have taken samples since the session was last run; the lock guards it. */
static bool session_is_due;

enum { RCLC_TASKS_TRIGGER_MS = 1000 };

static uint32_t larger(uint32_t a, uint32_t b)
{
  return a > b ? a : b;
}

/* Differences of two counts of microseconds are right across the wrap. Returns whether the run ended after its deadline. */
static bool task_count(uint8_t task)
{
  rclc_task_state_t * state = &rclc_task_states[task];
  rclc_task_counters_t * counters = &state->counters;
  const uint32_t now_us = port_task_time_us();
  const uint32_t response_us = now_us - state->released_us;
  const uint32_t deadline_us = rclc_task_plans[task].deadline_us;
  const bool is_late = deadline_us != 0u && response_us > deadline_us;

  microros_lock();
  ++counters->runs;
  counters->latest_us = larger(counters->latest_us, state->began_us - state->released_us);
  counters->longest_us = larger(counters->longest_us, now_us - state->began_us);
  counters->response_us = larger(counters->response_us, response_us);
  if (is_late) {
    ++counters->overruns;
    rcl_tasks_count(1, 0);
  }
  microros_unlock();
  return is_late;
}

static void task_report(uint8_t task, bool is_late, uint32_t missed)
{
  const rclc_task_state_t * state = &rclc_task_states[task];

  if (state->on_overrun != NULL && (is_late || missed != 0u)) {
    state->on_overrun(task, missed);
  }
}

static void task_count_error(uint8_t task)
{
  microros_lock();
  ++rclc_task_states[task].counters.failed;
  microros_unlock();
}

/* Leaves out the releases that have passed already, and returns their number; those that follow keep to the grid of the first
 * one. */
static uint32_t task_skip(uint8_t task)
{
  rclc_task_state_t * state = &rclc_task_states[task];
  const uint32_t period_us = rclc_task_plans[task].period_us;
  const uint32_t late_us = port_task_time_us() - state->next_us;
  uint32_t missed;

  if (late_us > (uint32_t)INT32_MAX) {
    return 0; /* it is still to come */
  }
  missed = late_us / period_us + 1u;
  state->next_us += missed * period_us;
  microros_lock();
  state->counters.missed += missed;
  rcl_tasks_count(0, missed);
  microros_unlock();
  return missed;
}

void rclc_tasks_run_period(uint8_t task)
{
  rclc_task_state_t * state = &rclc_task_states[task];

  while (rclc_tasks_continue(task)) {
    bool is_late;
    uint32_t missed = 0;

    port_task_sleep_until(state->next_us);
    if (!rclc_tasks_continue(task)) {
      break; /* it was stopped meanwhile */
    }
    state->released_us = state->next_us;
    state->began_us = port_task_time_us();
    if (state->callback != NULL) {
      state->callback(task);
    }
    if (rclc_executor_spin_some(state->executor, 0) != RCL_RET_OK) {
      task_count_error(task);
    }
    is_late = task_count(task);
    state->next_us += rclc_task_plans[task].period_us;
    if (rclc_task_plans[task].overrun != RCLC_TASK_CATCH_UP) {
      missed = task_skip(task);
    }
    task_report(task, is_late, missed);
    rclc_tasks_watch_period(task, state->next_us);
  }
}

/* Returns the calling task if it runs this executor and has no period, else MICROROS_TASKS. */
static uint8_t task_of(const rclc_executor_t * executor)
{
  const uint8_t task = port_task_self();

  return task < (uint8_t)MICROROS_TASKS && rclc_task_states[task].executor == executor &&
             rclc_task_plans[task].period_us == 0u
           ? task
           : (uint8_t)MICROROS_TASKS;
}

void rclc_tasks_round_begins(const rclc_executor_t * executor)
{
  const uint8_t task = task_of(executor);

  microros_lock();
  xrce_turn_set_round(true);
  microros_unlock();
  if (task < (uint8_t)MICROROS_TASKS) {
    rclc_task_state_t * state = &rclc_task_states[task];

    state->began_us = port_task_time_us();
    microros_lock();
    state->released_us = rmw_tasks_released(task, state->began_us);
    state->is_in_round = true;
    rclc_tasks_watch_release(task, state->released_us);
    microros_unlock();
  }
}

/* There may be room for further samples, which the session asks for. It counts as news, so that the task of the session
 * does not begin to wait before it has seen it. */
static void session_ask(void)
{
  microros_lock();
  xrce_turn_set_round(false);
  session_is_due = true;
  microros_note();
  if (rmw_client_instance()->waiting != 0u) {
    port_wake();
  }
  microros_unlock();
}

void rclc_tasks_round_ends(const rclc_executor_t * executor)
{
  const uint8_t task = task_of(executor);

  session_ask();
  if (task < (uint8_t)MICROROS_TASKS) {
    rclc_task_states[task].has_run = true;
    microros_lock();
    rclc_task_states[task].is_in_round = false;
    microros_unlock();
    task_report(task, task_count(task), 0);
    rclc_tasks_watch_rest(task);
  }
}

/* A trigger function of the application may look at what ends no wait. */
static uint64_t events_wait_most_ns(const rclc_executor_t * executor)
{
  const uint32_t most_ms = executor->trigger_function == rclc_executor_trigger_any
                             ? (uint32_t)RCLC_TASKS_WAIT_MOST_MS
                             : (uint32_t)RCLC_TASKS_TRIGGER_MS;

  return (uint64_t)most_ms * 1000000u;
}

void rclc_tasks_run_events(uint8_t task)
{
  rclc_task_state_t * state = &rclc_task_states[task];

  while (rclc_tasks_continue(task)) {
    if (rclc_executor_spin_some(state->executor, events_wait_most_ns(state->executor)) != RCL_RET_OK) {
      task_count_error(task);
      port_sleep_ms(1); /* an error that stays must not keep the processor from tasks of lower priority */
    }
    if (state->has_run && rclc_task_plans[task].interval_us != 0u) {
      port_task_sleep_until(state->began_us + rclc_task_plans[task].interval_us);
    }
    state->has_run = false;
    rclc_tasks_watch_rest(task);
  }
}

/* Returns whether a handle has become ready since the executor looked; else *look_again_ns is the time until one may be. */
static bool executor_has_news(const rclc_executor_t * executor, int64_t * look_again_ns)
{
  const rclc_executor_handle_t * handle = executor->handles;

  for (size_t left = executor->index; left != 0u; --left) { /* at most MICROROS_HANDLES_MAX rounds */
    bool is_ready = false;

    if (handle->kind->look(handle, &is_ready, look_again_ns) != RCL_RET_OK) {
      return true; /* the task reports it */
    }
    if (is_ready && !handle->data_available) {
      return true;
    }
    ++handle;
  }
  return false;
}

/* Returns whether the task has to look before its wait ends: another task set a timer, or a clock jumped. Times that were
 * rounded up at different moments differ by a millisecond. */
static bool task_is_sooner(uint8_t task, int64_t look_again_ns)
{
  const int64_t ns_per_ms = 1000000;
  const uint32_t left_ms = rmw_tasks_until_ms(task) - port_time_ms();

  return left_ms <= (uint32_t)RCLC_TASKS_WAIT_MOST_MS && look_again_ns < ((int64_t)left_ms - 1) * ns_per_ms;
}

/* What a callback waits for may be in no executor: the task looks itself. */
static void session_release_task(uint8_t task)
{
  const rclc_task_state_t * state = &rclc_task_states[task];
  int64_t look_again_ns = INT64_MAX;

  if (state->is_in_round || rclc_task_plans[task].period_us != 0u) {
    rmw_tasks_wake(task);
  } else if (executor_has_news(state->executor, &look_again_ns)) {
    const uint32_t now_us = port_task_time_us();

    rmw_tasks_release(task, now_us);
    rclc_tasks_watch_release(task, now_us);
  } else if (task_is_sooner(task, look_again_ns)) {
    rmw_tasks_wake(task);
  } else {
    /* it goes on waiting */
  }
}

/* A task that waits is in the wait as long as this one holds the lock, so its executor is at rest. Of those that do not
 * wait, each looks by itself before it does. */
static void session_release_tasks(void)
{
  microros_lock_silence(true);
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS - 1u; ++task) {
    if (rmw_tasks_waits(task)) {
      session_release_task(task);
    }
  }
  microros_lock_silence(false);
}

/* Returns whether something is due since the session was run: it does not wait then. */
static bool session_has_news(void)
{
  return session_is_due || xrce_turn_is_requested();
}

void rclc_tasks_run_session(uint8_t task)
{
  uint32_t news;

  rmw_tasks_take_line();
  while (rclc_tasks_continue(task)) {
    rclc_tasks_watch_run(task);
    rclc_task_states[task].began_us = port_task_time_us();
    rclc_task_states[task].released_us = rclc_task_states[task].began_us; /* nothing knows the release */
    microros_lock();
    session_is_due = false;
    xrce_turn_see();
    microros_unlock();
    rcl_waiting_receive();
    microros_lock();
    news = microros_news() - (session_has_news() ? 1u : 0u);
    session_release_tasks();
    microros_unlock();
    (void)task_count(task); /* the diagnosis has its overruns */
    rclc_tasks_watch_rest(task);
    if (!rmw_tasks_write()) { /* a transport that waits for its line does so in its rest */
      rmw_client_wait_news((uint32_t)RCLC_TASKS_WAIT_MOST_MS, &news);
    }
  }
  rmw_tasks_leave_line();
}
