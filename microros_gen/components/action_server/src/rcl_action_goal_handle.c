/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_action/goal_handle.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "rclc/action_goal_handle.h"

#include <stddef.h>

rcl_action_goal_handle_t rcl_action_get_zero_initialized_goal_handle(void)
{
  const rcl_action_goal_handle_t goal_handle = {NULL};

  return goal_handle;
}

bool rcl_action_goal_handle_is_valid(const rcl_action_goal_handle_t * goal_handle)
{
  if (goal_handle == NULL || goal_handle->impl == NULL || !goal_handle->impl->is_used) {
    (void)microros_error_refuse(RCL_RET_ACTION_GOAL_HANDLE_INVALID, "goal_handle");
    return false;
  }
  return true;
}

rcl_ret_t rcl_action_goal_handle_get_info(
  const rcl_action_goal_handle_t * goal_handle, rcl_action_goal_info_t * goal_info)
{
  rcl_ret_t result = RCL_RET_ACTION_GOAL_HANDLE_INVALID;

  microros_lock();
  if (rcl_action_goal_handle_is_valid(goal_handle)) {
    if (goal_info != NULL) {
      goal_info->goal_id = goal_handle->impl->goal_id;
      goal_info->stamp = goal_handle->impl->stamp;
      result = RCL_RET_OK;
    } else {
      result = microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_info");
    }
  }
  microros_unlock();
  return result;
}

rcl_ret_t rcl_action_goal_handle_get_status(
  const rcl_action_goal_handle_t * goal_handle, rcl_action_goal_state_t * status)
{
  rcl_ret_t result = RCL_RET_ACTION_GOAL_HANDLE_INVALID;

  microros_lock();
  if (rcl_action_goal_handle_is_valid(goal_handle)) {
    if (status != NULL) {
      *status = goal_handle->impl->status;
      result = RCL_RET_OK;
    } else {
      result = microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "status");
    }
  }
  microros_unlock();
  return result;
}

bool rcl_action_goal_handle_is_active(const rcl_action_goal_handle_t * goal_handle)
{
  rcl_action_goal_state_t status;

  return rcl_action_goal_handle_get_status(goal_handle, &status) == RCL_RET_OK &&
         status != GOAL_STATE_UNKNOWN && status <= GOAL_STATE_CANCELING;
}

bool rcl_action_goal_handle_is_cancelable(const rcl_action_goal_handle_t * goal_handle)
{
  rcl_action_goal_state_t status;

  return rcl_action_goal_handle_get_status(goal_handle, &status) == RCL_RET_OK &&
         rcl_action_transition_goal_state(status, GOAL_EVENT_CANCEL_GOAL) == GOAL_STATE_CANCELING;
}
