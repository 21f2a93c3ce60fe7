/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "rcl_action/types.h"

rcl_ret_t rcl_action_cancel_response_init(
  rcl_action_cancel_response_t * cancel_response, const size_t num_goals_canceling,
  const rcl_allocator_t allocator)
{
  void * goals;

  if (!rcutils_allocator_is_valid(&allocator) || cancel_response == NULL || num_goals_canceling == 0u) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "cancel_response, num_goals_canceling or allocator");
  }
  if (cancel_response->msg.return_code != 0 || cancel_response->msg.goals_canceling.size != 0u) {
    return microros_error_refuse(RCL_RET_ALREADY_INIT, "cancel_response");
  }
  goals = allocator.zero_allocate(num_goals_canceling, sizeof(rcl_action_goal_info_t), allocator.state);
  if (goals == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  cancel_response->msg.goals_canceling.data = goals;
  cancel_response->msg.goals_canceling.size = num_goals_canceling;
  cancel_response->msg.goals_canceling.capacity = num_goals_canceling;
  cancel_response->allocator = allocator;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_cancel_response_fini(rcl_action_cancel_response_t * cancel_response)
{
  if (cancel_response == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "cancel_response");
  }
  if (cancel_response->msg.goals_canceling.data != NULL) {
    cancel_response->allocator.deallocate(
      cancel_response->msg.goals_canceling.data, cancel_response->allocator.state);
    cancel_response->msg.goals_canceling.data = NULL;
    cancel_response->msg.goals_canceling.size = 0u;
    cancel_response->msg.goals_canceling.capacity = 0u;
  }
  return RCL_RET_OK;
}
