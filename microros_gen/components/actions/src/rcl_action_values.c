/* SPDX-License-Identifier: Apache-2.0 */
/* Messages of actions as rcl initializes them, and the states that a goal goes through. */
#include "rcl_action/types.h"

#include "microros/error.h"
#include "rcl_action/goal_state_machine.h"

rcl_action_goal_info_t rcl_action_get_zero_initialized_goal_info(void)
{
  rcl_action_goal_info_t goal_info;

  (void)memset(&goal_info, 0, sizeof(goal_info));
  return goal_info;
}

rcl_action_cancel_request_t rcl_action_get_zero_initialized_cancel_request(void)
{
  rcl_action_cancel_request_t request;

  (void)memset(&request, 0, sizeof(request));
  return request;
}

rcl_action_cancel_response_t rcl_action_get_zero_initialized_cancel_response(void)
{
  rcl_action_cancel_response_t response;

  (void)memset(&response, 0, sizeof(response));
  return response;
}

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

static rcl_action_goal_state_t goal_state_of_active(
  rcl_action_goal_event_t event, rcl_action_goal_state_t canceling, rcl_action_goal_state_t canceled)
{
  switch (event) {
    case GOAL_EVENT_SUCCEED:
      return GOAL_STATE_SUCCEEDED;
    case GOAL_EVENT_ABORT:
      return GOAL_STATE_ABORTED;
    case GOAL_EVENT_CANCEL_GOAL:
      return canceling;
    case GOAL_EVENT_CANCELED:
      return canceled;
    case GOAL_EVENT_EXECUTE:
    case GOAL_EVENT_NUM_EVENTS:
    default:
      return GOAL_STATE_UNKNOWN;
  }
}

rcl_action_goal_state_t rcl_action_transition_goal_state(
  const rcl_action_goal_state_t state, const rcl_action_goal_event_t event)
{
  switch (state) {
    case GOAL_STATE_ACCEPTED:
      if (event == GOAL_EVENT_EXECUTE) {
        return GOAL_STATE_EXECUTING;
      }
      return event == GOAL_EVENT_CANCEL_GOAL ? GOAL_STATE_CANCELING : GOAL_STATE_UNKNOWN;
    case GOAL_STATE_EXECUTING:
      return goal_state_of_active(event, GOAL_STATE_CANCELING, GOAL_STATE_UNKNOWN);
    case GOAL_STATE_CANCELING:
      return goal_state_of_active(event, GOAL_STATE_UNKNOWN, GOAL_STATE_CANCELED);
    default:
      return GOAL_STATE_UNKNOWN;
  }
}
