/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "rclc/executor.h"
#include "rmw_microros/session.h"

#include <stddef.h>

/* Lowers *duration_ns to the time until a handle may become ready; 0: one is, and no round has seen it. */
static rcl_ret_t due_look(const rclc_executor_t * executor, int64_t * duration_ns)
{
  const rclc_executor_handle_t * handle = executor->handles;

  for (size_t left = executor->index; left != 0u; --left) {
    bool is_ready = false;
    const rcl_ret_t result = handle->kind->look(handle, &is_ready, duration_ns);

    if (result != RCL_RET_OK) {
      return result;
    }
    if (is_ready && !handle->data_available) {
      *duration_ns = 0;
    }
    ++handle;
  }
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_time_until_due(const rclc_executor_t * executor, int64_t * duration_ns)
{
  rcl_ret_t result;
  int64_t left_ns = 0;

  if (executor == NULL || duration_ns == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor or duration_ns");
  }
  if (executor->handles == NULL || !rcl_context_is_valid(executor->context)) {
    return microros_error_refuse(RCL_RET_ERROR, "executor or its context");
  }
  if (rmw_uros_time_until_due(rcl_context_get_rmw_context(executor->context), &left_ns) != RMW_RET_OK) {
    return RCL_RET_ERROR;
  }
  result = due_look(executor, &left_ns);
  if (result == RCL_RET_OK) {
    *duration_ns = (left_ns > 0) ? left_ns : 0;
  }
  return result;
}
