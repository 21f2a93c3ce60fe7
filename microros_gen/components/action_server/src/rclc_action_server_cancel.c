/* SPDX-License-Identifier: Apache-2.0 */
/* Cancel requests: for one goal, for those accepted until a time, or for all (action_msgs/srv/CancelGoal). */
#include "action_msgs/srv/cancel_goal.h"
#include "microros/lock.h"
#include "microros/rclc_action_server.h"
#include "microros/rmw_service.h"

#include <string.h>

static bool action_cancel_has_id(const action_msgs__msg__GoalInfo * requested)
{
  static const uint8_t none[UUID_SIZE];

  return memcmp(requested->goal_id.uuid, none, UUID_SIZE) != 0;
}

static bool action_cancel_has_time(const action_msgs__msg__GoalInfo * requested)
{
  return requested->stamp.sec != 0 || requested->stamp.nanosec != 0u;
}

static bool action_cancel_is_until(
  const builtin_interfaces__msg__Time * stamp, const builtin_interfaces__msg__Time * end)
{
  return stamp->sec < end->sec || (stamp->sec == end->sec && stamp->nanosec <= end->nanosec);
}

/* Returns whether the request is for this goal; without id and time it is for all of them. */
static bool action_cancel_is_for(
  const action_msgs__msg__GoalInfo * requested, const rclc_action_goal_handle_t * goal)
{
  const bool has_id = action_cancel_has_id(requested);
  const bool has_time = action_cancel_has_time(requested);

  if (has_id && memcmp(goal->goal_id.uuid, requested->goal_id.uuid, UUID_SIZE) == 0) {
    return true;
  }
  return has_time ? action_cancel_is_until(&goal->stamp, &requested->stamp) : !has_id;
}

/* Asks the application; returns whether the goal is canceling. During the callback it already is, so that the callback
 * can end it. */
static bool action_cancel_call(const rclc_action_server_t * server, rclc_action_goal_handle_t * goal)
{
  bool cancels;

  microros_lock();
  cancels = goal->is_used && rclc_action_go(goal, GOAL_EVENT_CANCEL_GOAL);
  microros_unlock();
  if (!cancels) {
    return false;
  }
  if (server->cancel_callback(goal, server->context)) {
    goal->goal_cancelled = true;
    return true;
  }
  microros_lock();
  if (goal->status == GOAL_STATE_CANCELING) {
    goal->status = GOAL_STATE_EXECUTING;
  }
  microros_unlock();
  return false;
}

/* A client that names one goal is told why that cannot be canceled; otherwise nothing to cancel is no error. */
static int8_t action_cancel_code(
  const rclc_action_server_t * server, const action_msgs__msg__GoalInfo * requested, bool any)
{
  const rclc_action_goal_handle_t * goal;

  if (any) {
    return action_msgs__srv__CancelGoal_Response__ERROR_REJECTED;
  }
  if (!action_cancel_has_id(requested) || action_cancel_has_time(requested)) {
    return action_msgs__srv__CancelGoal_Response__ERROR_NONE;
  }
  microros_lock();
  goal = rclc_action_find(server, requested->goal_id.uuid);
  microros_unlock();
  return goal == NULL ? action_msgs__srv__CancelGoal_Response__ERROR_UNKNOWN_GOAL_ID
                      : action_msgs__srv__CancelGoal_Response__ERROR_GOAL_TERMINATED;
}

static bool action_cancel_is_possible(const rclc_action_goal_handle_t * goal)
{
  return goal->is_used &&
         rcl_action_transition_goal_state(goal->status, GOAL_EVENT_CANCEL_GOAL) == GOAL_STATE_CANCELING;
}

/* Fills the response; stops where a callback has finalized the server. */
static void action_cancel_goals(
  rclc_action_server_t * server, const action_msgs__msg__GoalInfo * requested,
  action_msgs__srv__CancelGoal_Response * response)
{
  const rclc_action_declared_t * declared = server->declared;
  bool any = false;

  for (size_t i = 0; i < server->goal_handles_memory_size && server->declared != NULL; ++i) {
    rclc_action_goal_handle_t * goal = &declared->goals[i];

    if (action_cancel_is_possible(goal) && action_cancel_is_for(requested, goal)) {
      any = true;
      declared->canceling[response->goals_canceling.size].goal_id = goal->goal_id;
      declared->canceling[response->goals_canceling.size].stamp = goal->stamp;
      if (action_cancel_call(server, goal)) {
        ++response->goals_canceling.size;
      }
    }
  }
  response->return_code = action_msgs__srv__CancelGoal_Response__ERROR_NONE;
  if (response->goals_canceling.size == 0u && server->declared != NULL) {
    response->return_code = action_cancel_code(server, requested, any);
  }
}

rcl_ret_t rclc_action_serve_cancel(rclc_action_server_t * server)
{
  action_msgs__srv__CancelGoal_Request requested;
  action_msgs__srv__CancelGoal_Response response;
  rmw_request_id_t request;
  bool taken = false;
  const rcl_ret_t result =
    rmw_replier_begin(server->rcl_handle.cancel_service.impl, &request, &requested, &taken);

  if (!taken) {
    return result;
  }
  response.goals_canceling.data = server->declared->canceling;
  response.goals_canceling.size = 0u;
  response.goals_canceling.capacity = server->declared->goals_max;
  action_cancel_goals(server, &requested.goal_info, &response);
  if (!rcl_service_is_valid(&server->rcl_handle.cancel_service)) {
    rmw_replier_abandon();
    return RCL_RET_OK; /* a callback has finalized it */
  }
  return rmw_replier_end(server->rcl_handle.cancel_service.impl, &request, &response);
}
