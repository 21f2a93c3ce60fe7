/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rclc_action_server.h"

/* Frees at most `capacity` places. Called with the lock. */
static size_t action_expire_goals(
  const rclc_action_declared_t * declared, const rcl_action_server_t * action_server,
  rcl_action_goal_info_t * expired_goals, size_t capacity)
{
  const uint32_t now = port_time_ms();
  size_t count = 0;

  for (size_t i = 0; i < declared->goals_max && count < capacity; ++i) {
    rclc_action_goal_handle_t * goal = &declared->goals[i];

    if (
      rclc_action_is_tracked(goal, action_server) &&
      rclc_action_left(goal, declared->result_timeout_ms, now) == 0u) {
      if (expired_goals != NULL) {
        expired_goals[count].goal_id = goal->goal_id;
        expired_goals[count].stamp = goal->stamp;
      }
      goal->is_used = false;
      ++count;
    }
  }
  return count;
}

rcl_ret_t rcl_action_expire_goals(
  const rcl_action_server_t * action_server, rcl_action_goal_info_t * expired_goals,
  size_t expired_goals_capacity, size_t * num_expired)
{
  const bool lists = expired_goals != NULL && expired_goals_capacity != 0u && num_expired != NULL;
  const rclc_action_declared_t * declared;
  size_t count = 0;
  size_t first;

  if (!rcl_action_server_is_valid(action_server)) {
    return microros_error_refuse(RCL_RET_ACTION_SERVER_INVALID, "action_server");
  }
  if (!lists && (expired_goals != NULL || expired_goals_capacity != 0u || num_expired != NULL)) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "expired_goals, expired_goals_capacity or num_expired");
  }
  microros_lock();
  declared = rclc_action_goals_of(action_server, &first);
  if (declared != NULL) {
    count =
      action_expire_goals(declared, action_server, expired_goals, lists ? expired_goals_capacity : SIZE_MAX);
  }
  microros_unlock();
  if (num_expired != NULL) {
    *num_expired = count;
  }
  return RCL_RET_OK;
}
