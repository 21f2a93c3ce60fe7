/* SPDX-License-Identifier: Apache-2.0 */
/* A call of rcl_action, which asks for the goals that rclc keeps. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_action_server.h"
#include "rcl_action/action_server.h"

#include <string.h>

static bool goals_have(
  const rclc_action_declared_t * declared, const rcl_action_server_t * action_server, const uint8_t * uuid)
{
  for (size_t i = 0; i < declared->goals_max; ++i) {
    const rclc_action_goal_handle_t * goal = &declared->goals[i];

    if (
      goal->is_used && goal->action_server != NULL && &goal->action_server->rcl_handle == action_server &&
      memcmp(goal->goal_id.uuid, uuid, UUID_SIZE) == 0) {
      return true;
    }
  }
  return false;
}

bool rcl_action_server_goal_exists(
  const rcl_action_server_t * action_server, const rcl_action_goal_info_t * goal_info)
{
  bool result = false;

  if (!rcl_action_server_is_valid(action_server)) {
    (void)microros_error_refuse(RCL_RET_ACTION_SERVER_INVALID, "action_server");
    return false;
  }
  if (goal_info == NULL) {
    (void)microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_info");
    return false;
  }
  microros_lock();
  for (size_t i = 0; i < MICROROS_ACTION_SERVERS && !result; ++i) {
    result = goals_have(&rclc_action_declared[i], action_server, goal_info->goal_id.uuid);
  }
  microros_unlock();
  return result;
}
