/* SPDX-License-Identifier: Apache-2.0 */
/* Goal requests, and cancel requests: for one goal, for those accepted until a time, or for all (action_msgs/srv/CancelGoal). */
#include "action_msgs/srv/cancel_goal.h"
#include "microros/epoch.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rclc_action_server.h"
#include "microros/rmw_service.h"

#include <string.h>

enum { ACTION_NS_PER_S = 1000000000, ACTION_NS_PER_MS = 1000000 };

rclc_action_goal_handle_t * rclc_action_find(const rclc_action_server_t * server, const uint8_t * uuid)
{
  /* at most MICROROS_ACTION_SERVER_GOALS rounds */
  for (size_t i = 0; i < server->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &server->declared->goals[i];

    if (goal->is_used && memcmp(goal->goal_id.uuid, uuid, UUID_SIZE) == 0) {
      return goal;
    }
  }
  return NULL;
}

/* Returns whether the place of `goal` is used again rather than that of `other`. */
static bool action_goal_is_older(
  const rclc_action_goal_handle_t * goal, const rclc_action_goal_handle_t * other, uint32_t now)
{
  return other == NULL || now - goal->ended_ms > now - other->ended_ms;
}

rclc_action_goal_handle_t * rclc_action_take_place(const rclc_action_server_t * server)
{
  const uint32_t now = port_time_ms();
  rclc_action_goal_handle_t * oldest = NULL;

  for (size_t i = 0; i < server->goals_at_once; ++i) { /* at most MICROROS_ACTION_SERVER_GOALS rounds */
    rclc_action_goal_handle_t * goal = &server->declared->goals[i];

    if (!goal->is_used) {
      return goal;
    }
    if (
      rclc_action_has_ended(goal) && goal->result_sent && goal->waiting == 0u &&
      action_goal_is_older(goal, oldest, now)) {
      oldest = goal;
    }
  }
  return oldest;
}

uint32_t rclc_action_left(const rclc_action_goal_handle_t * goal, uint32_t result_timeout_ms, uint32_t now)
{
  if (!goal->is_used || !rclc_action_has_ended(goal) || goal->waiting != 0u) {
    return UINT32_MAX;
  }
  return now - goal->ended_ms < result_timeout_ms ? result_timeout_ms - (now - goal->ended_ms) : 0u;
}

uint32_t rclc_action_expire(const rclc_action_server_t * server, bool frees)
{
  const uint32_t now = port_time_ms();
  uint32_t left = UINT32_MAX;

  /* at most MICROROS_ACTION_SERVER_GOALS rounds */
  for (size_t i = 0; i < server->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &server->declared->goals[i];
    const uint32_t due = rclc_action_left(goal, server->declared->result_timeout_ms, now);

    if (due == 0u && frees) {
      goal->is_used = false;
    } else if (due < left) {
      left = due;
    }
  }
  return left;
}

bool rclc_action_go(rclc_action_goal_handle_t * goal, rcl_action_goal_event_t event)
{
  const rcl_action_goal_state_t state = rcl_action_transition_goal_state(goal->status, event);

  if (state == GOAL_STATE_UNKNOWN) {
    return false;
  }
  goal->status = state;
  goal->action_server->status_due = true;
  return true;
}

/* The time of day, or the time since the start as long as it is not known. */
static builtin_interfaces__msg__Time action_goal_now(void)
{
  const int64_t epoch_ns = microros_epoch_known_ns();
  const int64_t now_ns = epoch_ns > 0 ? epoch_ns : (int64_t)port_time_ms() * ACTION_NS_PER_MS;
  builtin_interfaces__msg__Time stamp;

  stamp.sec = (int32_t)(now_ns / ACTION_NS_PER_S);
  stamp.nanosec = (uint32_t)(now_ns % ACTION_NS_PER_S);
  return stamp;
}

static void action_goal_accept(rclc_action_server_t * server, rclc_action_goal_handle_t * goal)
{
  microros_lock();
  goal->stamp = action_goal_now();
  goal->status = GOAL_STATE_ACCEPTED;
  server->status_due = true;
  microros_unlock();
}

/* The state `accepted` is published where there is room: a client sees it before `executing`. */
static rcl_ret_t action_goal_execute(rclc_action_server_t * server, rclc_action_goal_handle_t * goal)
{
  const rcl_ret_t result = rclc_action_has_status(server) ? rclc_action_publish_status(server) : RCL_RET_OK;

  microros_lock();
  (void)rclc_action_go(goal, GOAL_EVENT_EXECUTE); /* possible: only the executor leaves `accepted` */
  microros_unlock();
  return result;
}

static rcl_ret_t action_goal_refuse(rclc_action_server_t * server, const char * why)
{
  ++server->refused_goals;
  microros_error_set(microros_error_action_goal_refused, rclc_action_name(server), why, 0, 0);
  return RCL_RET_ERROR;
}

/* Calls the callback; returns whether it accepted the goal. */
static bool action_goal_call(rclc_action_server_t * server, rclc_action_goal_handle_t * goal)
{
  const bool accepted = server->goal_callback(goal, server->context) == RCL_RET_ACTION_GOAL_ACCEPTED;

  if (!accepted) {
    goal->is_used = false;
  } else if (goal->is_used) { /* the callback may have finalized the server */
    action_goal_accept(server, goal);
  }
  return accepted;
}

rcl_ret_t rclc_action_serve_goal(rclc_action_server_t * server)
{
  rclc_action_incoming_t incoming = {.server = server, .goal = NULL, .refused = NULL};
  rclc_action_answer_t answer = {.accepted = false};
  rmw_request_id_t request;
  bool taken = false;
  rcl_ret_t result = rmw_replier_begin(server->rcl_handle.goal_service.impl, &request, &incoming, &taken);

  if (!taken) {
    return result;
  }
  if (incoming.goal != NULL && action_goal_call(server, incoming.goal)) {
    answer.accepted = true;
    answer.stamp = incoming.goal->stamp;
  }
  if (!rcl_service_is_valid(&server->rcl_handle.goal_service)) {
    rmw_replier_abandon();
    return RCL_RET_OK; /* the callback has finalized it */
  }
  result = rmw_replier_end(server->rcl_handle.goal_service.impl, &request, &answer);
  if (answer.accepted) {
    const rcl_ret_t published = action_goal_execute(server, incoming.goal);

    return result != RCL_RET_OK ? result : published;
  }
  return incoming.goal == NULL && result == RCL_RET_OK ? action_goal_refuse(server, incoming.refused)
                                                       : result;
}

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
