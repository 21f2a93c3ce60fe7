/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/tasks.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_tasks.h"
#include "microros/rclc_tasks_state.h"
#include "microros/rclc_tasks_watch.h"
#include "microros/rmw_tasks.h"
#include "microros/wake.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

static bool tasks_run;    /* the lock guards both */
static bool tasks_change; /* a call starts or ends some of them */

bool rclc_tasks_continue(uint8_t task)
{
  bool continues;

  microros_lock();
  continues = rclc_task_states[task].continues;
  microros_unlock();
  return continues;
}

static bool tasks_are_running(void)
{
  bool are_running;

  microros_lock();
  are_running = tasks_run;
  microros_unlock();
  return are_running;
}

static rcl_ret_t tasks_refuse(const char * why)
{
  return microros_error_named(RCL_RET_ERROR, microros_error_tasks, why);
}

static bool has_executor(uint8_t task)
{
  return task < (uint8_t)MICROROS_TASKS - 1u;
}

rcl_ret_t rclc_task_set_executor(uint8_t task, rclc_executor_t * executor, rclc_task_callback_t callback)
{
  if (!has_executor(task) || executor == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "task or executor");
  }
  if (tasks_are_running()) {
    return tasks_refuse("they run");
  }
  rclc_task_states[task].executor = executor;
  rclc_task_states[task].callback = callback;
  return RCL_RET_OK;
}

rcl_ret_t rclc_task_set_overrun(uint8_t task, rclc_task_overrun_callback_t callback)
{
  if (!has_executor(task) || rclc_task_plans[task].overrun != RCLC_TASK_CALL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "task");
  }
  if (tasks_are_running()) {
    return tasks_refuse("they run");
  }
  rclc_task_states[task].on_overrun = callback;
  return RCL_RET_OK;
}

static bool task_is_ready(uint8_t task)
{
  const rclc_task_state_t * state = &rclc_task_states[task];

  return state->executor != NULL &&
         (rclc_task_plans[task].overrun != RCLC_TASK_CALL || state->on_overrun != NULL);
}

/* Meanwhile nobody asks the port for the task. Some ports do not know the stack any more when the task has ended, so its
 * last mark is read before, too. */
static void task_join(uint8_t task)
{
  rclc_task_state_t * state = &rclc_task_states[task];
  uint32_t before;
  uint32_t after;

  microros_lock();
  before = port_task_stack_peak(task);
  state->stack_peak = before;
  state->is_made = false;
  microros_unlock();
  port_task_join(task);
  after = port_task_stack_peak(task);
  microros_lock();
  state->stack_peak = after > before ? after : before;
  microros_unlock();
}

/* Says that a task is to end. The caller holds the lock. */
static void task_notify(uint8_t task)
{
  rclc_task_states[task].continues = false;
  rmw_tasks_end(task);
}

/* Ends a task that was told. It is watched until it has ended. */
static void task_end(uint8_t task)
{
  if (rclc_task_states[task].is_made) {
    port_task_set(task);
    task_join(task);
  }
  microros_lock();
  rclc_tasks_watch_end(task);
  microros_unlock();
}

static void tasks_end(void)
{
  microros_lock();
  tasks_run = false;
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    task_notify(task);
  }
  microros_wake(); /* the session waits for the line; what is about to wait looks again */
  microros_unlock();
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    if (rclc_task_states[task].is_made) {
      port_task_set(task); /* all first, so that they end at once */
    }
  }
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    task_end(task);
  }
}

/* Nothing of a start before is left; a task with a period has its first release now. The caller holds the lock. */
static void task_prepare(uint8_t task)
{
  rclc_task_state_t * state = &rclc_task_states[task];

  state->next_us = port_task_first_release_us();
  state->stack_peak = 0;
  state->has_run = false;
  state->is_in_round = false;
  state->continues = true;
  rmw_tasks_begin(task);
  rclc_tasks_watch_begin(task);
}

/* The task may have a higher priority than the caller, so it must not run before it counts as made. */
static bool task_make(uint8_t task)
{
  bool is_made;

  microros_lock();
  is_made = port_task_create(task, &rclc_task_settings[task]);
  rclc_task_states[task].is_made = is_made;
  microros_unlock();
  return is_made;
}

/* Begins to start or end tasks, if the tasks run or not, as wanted, and no other call does so. */
static bool change_begin(bool while_they_run)
{
  bool begins;

  microros_lock();
  begins = !tasks_change && tasks_run == while_they_run;
  tasks_change = tasks_change || begins;
  microros_unlock();
  return begins;
}

static rcl_ret_t change_end(rcl_ret_t result)
{
  microros_lock();
  tasks_change = false;
  microros_unlock();
  return result;
}

static bool tasks_are_ready(void)
{
  bool are_ready = true;

  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS - 1u; ++task) {
    are_ready = are_ready && task_is_ready(task);
  }
  return are_ready;
}

rcl_ret_t rclc_tasks_start(void)
{
  if (!change_begin(false)) {
    return tasks_refuse("they run");
  }
  if (!tasks_are_ready()) {
    return change_end(tasks_refuse("a task has no executor, or no function for its overruns"));
  }
  microros_lock();
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    (void)memset(&rclc_task_states[task].counters, 0, sizeof(rclc_task_states[task].counters));
    task_prepare(task);
  }
  tasks_run = true;
  microros_unlock();
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    if (!task_make(task)) {
      tasks_end();
      return change_end(tasks_refuse("the system makes no task"));
    }
  }
  return change_end(RCL_RET_OK);
}

rcl_ret_t rclc_tasks_stop(void)
{
  if (port_task_self() != (uint8_t)PORT_TASK_NONE || !change_begin(true)) {
    return tasks_refuse("they do not run, or one of them is the caller");
  }
  tasks_end();
  return change_end(RCL_RET_OK);
}

rcl_ret_t rclc_task_stop(uint8_t task)
{
  if (!has_executor(task)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "task");
  }
  if (port_task_self() == task || !change_begin(true)) {
    return tasks_refuse("they do not run, another call stops one, or it is the caller");
  }
  if (!rclc_task_states[task].is_made) {
    return change_end(tasks_refuse("it is stopped"));
  }
  microros_lock();
  task_notify(task);
  microros_unlock();
  task_end(task);
  return change_end(RCL_RET_OK);
}

rcl_ret_t rclc_task_start(uint8_t task)
{
  if (!has_executor(task)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "task");
  }
  if (!change_begin(true)) {
    return tasks_refuse("they do not run, or another call stops one");
  }
  if (rclc_task_states[task].is_made) {
    return change_end(tasks_refuse("it runs"));
  }
  microros_lock();
  task_prepare(task);
  microros_unlock();
  if (!task_make(task)) {
    microros_lock();
    task_notify(task);
    rclc_tasks_watch_end(task);
    microros_unlock();
    return change_end(tasks_refuse("the system makes no task"));
  }
  return change_end(RCL_RET_OK);
}

bool rclc_tasks_are_prioritized(void)
{
  bool are_prioritized;

  microros_lock();
  are_prioritized = port_task_has_priorities();
  microros_unlock();
  return are_prioritized;
}

rcl_ret_t rclc_task_get_counters(uint8_t task, rclc_task_counters_t * counters)
{
  if (task >= (uint8_t)MICROROS_TASKS || counters == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "task or counters");
  }
  microros_lock();
  *counters = rclc_task_states[task].counters;
  microros_unlock();
  return RCL_RET_OK;
}

uint32_t rclc_task_stack_peak(uint8_t task)
{
  uint32_t peak = 0;

  if (task < (uint8_t)MICROROS_TASKS) {
    microros_lock();
    peak = rclc_task_states[task].is_made ? port_task_stack_peak(task) : rclc_task_states[task].stack_peak;
    microros_unlock();
  }
  return peak;
}

uint32_t rclc_task_stack_size(uint8_t task)
{
  return task < (uint8_t)MICROROS_TASKS ? rclc_task_settings[task].stack_size : 0u;
}

/* The lock keeps the task from being joined meanwhile. */
rcl_ret_t rclc_task_set_priority(uint8_t task, uint8_t priority)
{
  bool is_set;

  if (task >= (uint8_t)MICROROS_TASKS || priority == 0u || priority > (uint8_t)MICROROS_TASKS) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "task or priority");
  }
  microros_lock();
  is_set = rclc_task_states[task].is_made &&
           port_task_set_priority(task, (uint8_t)((uint8_t)MICROROS_TASKS + 1u - priority));
  microros_unlock();
  return is_set ? RCL_RET_OK
                : microros_error_named(
                    RCL_RET_ERROR, microros_error_tasks, "it does not run, or the system has no priorities");
}
