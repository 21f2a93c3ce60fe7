/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/tasks.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_tasks.h"
#include "microros/rclc_tasks_state.h"
#include "microros/rclc_tasks_watch.h"
#include "microros/rmw_tasks.h"
#include "microros/wake.h"

#include <stddef.h>
#include <string.h>

static bool tasks_run;

bool rclc_tasks_continue(void)
{
  bool is_running;

  microros_lock();
  is_running = tasks_run;
  microros_unlock();
  return is_running;
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
  if (rclc_tasks_continue()) {
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
  if (rclc_tasks_continue()) {
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

/* Ends the first `count` tasks. */
static void tasks_end(uint8_t count)
{
  microros_lock();
  tasks_run = false;
  rmw_tasks_set_running(false);
  microros_unlock();
  microros_wake(); /* the session waits for the line; what is about to wait looks again */
  for (uint8_t task = 0; task < count; ++task) {
    port_task_set(task);
  }
  for (uint8_t task = 0; task < count; ++task) {
    task_join(task);
  }
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

rcl_ret_t rclc_tasks_start(void)
{
  if (rclc_tasks_continue()) {
    return tasks_refuse("they run");
  }
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS - 1u; ++task) {
    if (!task_is_ready(task)) {
      return tasks_refuse("a task has no executor, or no function for its overruns");
    }
    rclc_task_states[task].next_us = port_task_time_us();
  }
  microros_lock();
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    (void)memset(&rclc_task_states[task].counters, 0, sizeof(rclc_task_states[task].counters));
    (void)rmw_tasks_released(task, 0); /* of a start before */
    rclc_task_states[task].stack_peak = 0;
  }
  rclc_tasks_watch_begin();
  tasks_run = true;
  rmw_tasks_set_running(true);
  microros_unlock();
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    if (!task_make(task)) {
      tasks_end(task);
      return tasks_refuse("the system makes no task");
    }
  }
  return RCL_RET_OK;
}

rcl_ret_t rclc_tasks_stop(void)
{
  if (!rclc_tasks_continue() || port_task_self() != (uint8_t)PORT_TASK_NONE) {
    return tasks_refuse("they do not run, or one of them is the caller");
  }
  tasks_end((uint8_t)MICROROS_TASKS);
  return RCL_RET_OK;
}

bool rclc_tasks_are_prioritized(void)
{
  return port_task_has_priorities();
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
