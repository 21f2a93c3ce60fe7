/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_action/types.h"

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
