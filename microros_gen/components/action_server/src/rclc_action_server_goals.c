/* SPDX-License-Identifier: Apache-2.0 */
/* What functions of rcl_action ask of the goals that rclc keeps. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_action_server.h"

#include <string.h>

static bool goals_are_of(const rclc_action_goal_handle_t * goal, const rcl_action_server_t * action_server)
{
  return goal->action_server != NULL && &goal->action_server->rcl_handle == action_server;
}

const rclc_action_declared_t * rclc_action_goals_of(const rcl_action_server_t * action_server, size_t * first)
{
  *first = 0;
  for (size_t i = 0; i < MICROROS_ACTION_SERVERS; ++i) {
    const rclc_action_declared_t * declared = &rclc_action_declared[i];

    if (goals_are_of(&declared->goals[0], action_server)) { /* each server has one at least */
      return declared;
    }
    *first += declared->goals_max;
  }
  *first = 0;
  return NULL;
}

bool rclc_action_is_tracked(const rclc_action_goal_handle_t * goal, const rcl_action_server_t * action_server)
{
  return goal->is_used && goal->status != GOAL_STATE_UNKNOWN && goals_are_of(goal, action_server);
}

static bool goals_have(const rclc_action_declared_t * declared, const uint8_t * uuid)
{
  for (size_t i = 0; i < declared->goals_max; ++i) {
    const rclc_action_goal_handle_t * goal = &declared->goals[i];

    if (goal->is_used && memcmp(goal->goal_id.uuid, uuid, UUID_SIZE) == 0) {
      return true;
    }
  }
  return false;
}

bool rcl_action_server_goal_exists(
  const rcl_action_server_t * action_server, const rcl_action_goal_info_t * goal_info)
{
  const rclc_action_declared_t * declared;
  size_t first;
  bool result;

  if (!rcl_action_server_is_valid(action_server)) {
    (void)microros_error_refuse(RCL_RET_ACTION_SERVER_INVALID, "action_server");
    return false;
  }
  if (goal_info == NULL) {
    (void)microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_info");
    return false;
  }
  microros_lock();
  declared = rclc_action_goals_of(action_server, &first);
  result = declared != NULL && goals_have(declared, goal_info->goal_id.uuid);
  microros_unlock();
  return result;
}
