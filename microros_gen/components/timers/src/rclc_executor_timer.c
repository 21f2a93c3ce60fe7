/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/rcl_timer.h"

static rcl_ret_t timer_look(const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  int64_t until_ns = INT64_MAX;
  const rcl_ret_t result = rcl_timer_look(handle->timer, is_ready, &until_ns);

  *look_again_ns = until_ns < *look_again_ns ? until_ns : *look_again_ns;
  return result;
}

static rcl_ret_t timer_call(rclc_executor_handle_t * handle)
{
  const rcl_ret_t result = rcl_timer_call(handle->timer);

  return result == RCL_RET_TIMER_CANCELED ? RCL_RET_OK : result; /* an earlier callback has canceled it */
}

rcl_ret_t rclc_executor_add_timer(rclc_executor_t * executor, rcl_timer_t * timer)
{
  static const rclc_handle_kind_t kind = {timer_look, rclc_handle_take_nothing, timer_call};
  rclc_executor_handle_t * handle;

  if (executor == NULL || timer == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor or timer");
  }
  handle = rclc_executor_add_handle(executor, RCLC_TIMER, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->timer = timer;
  ++executor->info.number_of_timers;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_timer(rclc_executor_t * executor, const rcl_timer_t * timer)
{
  const rcl_ret_t result = rclc_executor_remove_handle(executor, timer);

  if (result == RCL_RET_OK) {
    --executor->info.number_of_timers;
  }
  return result;
}
