/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/rcl_guard_condition.h"

#include <stddef.h>

static rcl_ret_t guard_look(const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  (void)look_again_ns; /* a trigger wakes the executor */
  if (!rcl_guard_condition_is_valid(handle->gc)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "guard condition");
  }
  *is_ready = rcl_guard_condition_is_ready(handle->gc);
  return RCL_RET_OK;
}

static rcl_ret_t guard_take(rclc_executor_handle_t * handle)
{
  rcl_guard_condition_acknowledge(handle->gc);
  return RCL_RET_OK;
}

static rcl_ret_t guard_call(rclc_executor_handle_t * handle)
{
  handle->callback.gc();
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_add_guard_condition(
  rclc_executor_t * executor, rcl_guard_condition_t * gc, rclc_gc_callback_t callback)
{
  static const rclc_handle_kind_t kind = {guard_look, guard_take, guard_call};
  rclc_executor_handle_t * handle;

  if (executor == NULL || gc == NULL || callback == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor, gc or callback");
  }
  handle = rclc_executor_add_handle(executor, RCLC_GUARD_CONDITION, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->gc = gc;
  handle->callback.gc = callback;
  ++executor->info.number_of_guard_conditions;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_guard_condition(
  rclc_executor_t * executor, const rcl_guard_condition_t * guard_condition)
{
  const rcl_ret_t result = rclc_executor_remove_handle(executor, guard_condition);

  if (result == RCL_RET_OK) {
    --executor->info.number_of_guard_conditions;
  }
  return result;
}
