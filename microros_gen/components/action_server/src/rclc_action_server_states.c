/* SPDX-License-Identifier: Apache-2.0 */
/* The states of the goals of a server, for rcl_action. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_action_server.h"
#include "rcl/allocator.h"

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
