/* SPDX-License-Identifier: Apache-2.0 */
/* Lists of the goals of a server, for rcl_action. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_action_server.h"

#include <string.h>

rcl_ret_t rcl_action_server_get_goal_handles(
  const rcl_action_server_t * action_server, rcl_action_goal_handle_t *** goal_handles, size_t * num_goals)
{
  static rcl_action_goal_handle_t handles[MICROROS_ACTION_SERVER_GOALS];
  static rcl_action_goal_handle_t * listed[MICROROS_ACTION_SERVER_GOALS];
  size_t first;
  size_t count = 0;

  if (!rcl_action_server_is_valid(action_server)) {
    return microros_error_refuse(RCL_RET_ACTION_SERVER_INVALID, "action_server");
  }
  if (goal_handles == NULL || num_goals == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handles or num_goals");
  }
  microros_lock();
  const rclc_action_declared_t * declared = rclc_action_goals_of(action_server, &first);
  for (size_t i = 0; declared != NULL && i < declared->goals_max; ++i) {
    if (rclc_action_is_tracked(&declared->goals[i], action_server)) {
      handles[first + i].impl = &declared->goals[i];
      listed[first + count] = &handles[first + i];
      ++count;
    }
  }
  microros_unlock();
  *goal_handles = &listed[first];
  *num_goals = count;
  return RCL_RET_OK;
}
