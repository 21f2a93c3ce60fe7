/* SPDX-License-Identifier: Apache-2.0 */
/* What functions of rcl_action ask of the goals that rclc keeps. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rclc_action_server.h"
#include "rcl/allocator.h"

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

rcl_ret_t rcl_action_get_goal_status_array(
  const rcl_action_server_t * action_server, rcl_action_goal_status_array_t * status_message)
{
  const rclc_action_declared_t * declared;
  size_t first;
  size_t count = 0;
  rcl_ret_t result;

  if (!rcl_action_server_is_valid(action_server)) {
    return microros_error_refuse(RCL_RET_ACTION_SERVER_INVALID, "action_server");
  }
  if (status_message == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "status_message");
  }
  microros_lock();
  declared = rclc_action_goals_of(action_server, &first);
  microros_unlock();
  if (declared == NULL) {
    return RCL_RET_OK; /* no executor has had it: it has no goals */
  }
  result =
    rcl_action_goal_status_array_init(status_message, declared->goals_max, rcl_get_default_allocator());
  if (result != RCL_RET_OK) {
    return result;
  }
  microros_lock();
  for (size_t i = 0; i < declared->goals_max; ++i) {
    const rclc_action_goal_handle_t * goal = &declared->goals[i];

    if (rclc_action_is_tracked(goal, action_server)) {
      status_message->msg.status_list.data[count].goal_info.goal_id = goal->goal_id;
      status_message->msg.status_list.data[count].goal_info.stamp = goal->stamp;
      status_message->msg.status_list.data[count].status = goal->status;
      ++count;
    }
  }
  microros_unlock();
  status_message->msg.status_list.size = count;
  return RCL_RET_OK;
}

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
