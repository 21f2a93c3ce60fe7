/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/port.h"
#include "microros/rcl_waiting.h"
#include "microros/rclc_handle_call.h"
#include "microros/rmw_turn.h"
#include "microros/time_math.h"
#include "microros_config.h"

/* Pause between rounds that end with an error at once. */
static const int64_t pause_after_error_ns = 1000000;

/* Looks at all handles; *changed: a handle has become ready. */
static rcl_ret_t executor_look(const rclc_executor_t * executor, bool * changed, int64_t * look_again_ns)
{
  rclc_executor_handle_t * handle = executor->handles;

  *changed = false;
  *look_again_ns = INT64_MAX;
  for (size_t left = executor->index; left != 0u; --left) {
    bool is_ready = false;
    const rcl_ret_t result = handle->kind->look(handle, &is_ready, look_again_ns);

    if (result != RCL_RET_OK) {
      return result;
    }
    if (is_ready && !handle->data_available) {
      *changed = true;
    }
    handle->data_available = is_ready;
    ++handle;
  }
  return RCL_RET_OK;
}

/* Another task may have ended this one, or the context. */
static bool executor_is_over(const rclc_executor_t * executor)
{
  return rmw_turn_is_over() || (MICROROS_TASKS_SHARE != 0u && !rcl_context_is_valid(executor->context));
}

static rcl_ret_t executor_wait(const rclc_executor_t * executor, int64_t timeout_ns)
{
  rcl_waiting_t waiting = rcl_waiting_begin(timeout_ns);

  for (;;) {
    bool changed = false;
    int64_t look_again_ns = INT64_MAX;
    rcl_ret_t result;

    rcl_waiting_receive();
    result = executor_look(executor, &changed, &look_again_ns);
    /* cppcheck-suppress knownConditionTrueFalse ; without other tasks nobody ends it */
    if (result != RCL_RET_OK || changed || rcl_waiting_is_over(&waiting) || executor_is_over(executor)) {
      return result;
    }
    rcl_waiting_rest(&waiting, look_again_ns);
  }
}

static rcl_ret_t handle_take(rclc_executor_handle_t * handle)
{
  const rcl_ret_t result = handle->data_available ? handle->kind->take(handle) : RCL_RET_OK;

  if (result != RCL_RET_OK) {
    handle->data_available = false;
  }
  return result;
}

static bool handle_is_due(const rclc_executor_handle_t * handle)
{
  return handle->data_available || handle->invocation == ALWAYS;
}

static rcl_ret_t handle_call(rclc_executor_handle_t * handle)
{
  return handle_is_due(handle) ? rclc_handle_call(handle) : RCL_RET_OK;
}

static void executor_note(rcl_ret_t * first, rcl_ret_t result)
{
  if (*first == RCL_RET_OK) {
    *first = result;
  }
}

/* Returns the first handle that still has a turn in this round, or NULL. */
static rclc_executor_handle_t * executor_next(const rclc_executor_t * executor)
{
  rclc_executor_handle_t * handle = executor->handles;

  for (size_t left = executor->index; left != 0u; --left) {
    if (handle->has_turn) {
      return handle;
    }
    ++handle;
  }
  return NULL;
}

/* A callback may remove handles, including its own, which moves those after it, or finalize the executor;
 * handles that it adds have their first turn in the next round. Therefore each turn searches for its
 * handle, and only handles with something to do have a turn. */
static rcl_ret_t executor_process(const rclc_executor_t * executor)
{
  const bool takes_first = executor->data_comm_semantics == RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME;
  rclc_executor_handle_t * handle = executor->handles;
  rcl_ret_t first = RCL_RET_OK;

  for (size_t left = executor->index; left != 0u; --left) {
    handle->has_turn = handle_is_due(handle);
    if (takes_first) {
      executor_note(&first, handle_take(handle));
    }
    ++handle;
  }
  for (handle = executor_next(executor); handle != NULL; handle = executor_next(executor)) {
    handle->has_turn = false;
    if (!takes_first) {
      executor_note(&first, handle_take(handle));
    }
    executor_note(&first, handle_call(handle));
  }
  handle = executor->handles;
  for (size_t left = executor->index; left != 0u; --left) {
    handle->data_available = false;
    ++handle;
  }
  return first;
}

rcl_ret_t rclc_executor_spin_some(rclc_executor_t * executor, const uint64_t timeout_ns)
{
  rcl_ret_t result;

  if (executor == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor");
  }
  if (executor->handles == NULL || !rcl_context_is_valid(executor->context)) {
    return microros_error_refuse(RCL_RET_ERROR, "executor or its context");
  }
  result = executor_wait(executor, timeout_ns > (uint64_t)INT64_MAX ? -1 : (int64_t)timeout_ns);
  if (
    result == RCL_RET_OK &&
    executor->trigger_function(
      executor->handles, (unsigned int)executor->max_handles, executor->trigger_object)) {
    result = executor_process(executor);
  }
  return result;
}

/* Returns whether to continue with further rounds after `result`. */
static bool executor_continues(const rclc_executor_t * executor, rcl_ret_t result)
{
  return result == RCL_RET_OK || result == RCL_RET_TIMEOUT ||
         ((result == RCL_RET_ERROR || result == RCL_RET_BAD_ALLOC || result == RCL_RET_UNSUPPORTED) &&
          executor->handles != NULL && rcl_context_is_valid(executor->context));
}

static void executor_rest(int64_t duration_ns)
{
  rcl_waiting_t waiting = rcl_waiting_begin(duration_ns > 0 ? duration_ns : 0);

  while (!rcl_waiting_is_over(&waiting)) {
    rcl_waiting_rest(&waiting, INT64_MAX);
    rcl_waiting_receive();
  }
}

/*
 * Longest wait of a round whose end is not observed. A time-out makes nothing ready; it only serves
 * trigger functions that look at other state.
 */
static uint64_t executor_wait_limit(const rclc_executor_t * executor)
{
  return executor->trigger_function == rclc_executor_trigger_any ? UINT64_MAX : executor->timeout_ns;
}

rcl_ret_t rclc_executor_spin(rclc_executor_t * executor)
{
  if (executor == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor");
  }
  for (;;) {
    const rcl_ret_t result = rclc_executor_spin_some(executor, executor_wait_limit(executor));

    if (!executor_continues(executor, result)) {
      return result;
    }
    if (result != RCL_RET_OK) {
      executor_rest(pause_after_error_ns);
    }
  }
}

rcl_ret_t rclc_executor_spin_one_period(rclc_executor_t * executor, const uint64_t period)
{
  rcl_ret_t result;

  if (executor == NULL || period > (uint64_t)INT64_MAX) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor or period");
  }
  if (executor->invocation_time == 0) {
    executor->invocation_time = port_time_steady_ns();
  }
  result = rclc_executor_spin_some(executor, executor->timeout_ns);
  if (executor_continues(executor, result)) {
    executor->invocation_time = microros_time_after(executor->invocation_time, (int64_t)period);
    executor_rest(executor->invocation_time - port_time_steady_ns()); /* neither is negative */
  }
  return result;
}

rcl_ret_t rclc_executor_spin_period(rclc_executor_t * executor, const uint64_t period)
{
  rcl_ret_t result;

  do {
    result = rclc_executor_spin_one_period(executor, period);
  } while (executor != NULL && executor_continues(executor, result));
  return result;
}
