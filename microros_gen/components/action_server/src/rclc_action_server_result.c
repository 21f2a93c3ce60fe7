/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Results: encoded when a goal ends, sent to everybody who asks before or afterwards. The states of all goals, which are
 * published when one changes.
 */
#include "action_msgs/msg/goal_status_array.h"
#include "microros/action_type.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rclc_action_server.h"
#include "microros/rmw_action_server.h"
#include "microros/rmw_client.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_service.h"
#include "microros/wake.h"

#include <string.h>

bool rclc_action_has_status(const rclc_action_server_t * server)
{
  const bool is_due = server->status_due || server->session != (uint8_t)rmw_client_reconnects();

  return is_due && rmw_action_server_may_publish(server->rcl_handle.status_publisher.impl);
}

/* Called with the lock. */
static size_t action_status_fill(const rclc_action_server_t * server)
{
  size_t count = 0;

  /* at most MICROROS_ACTION_SERVER_GOALS rounds */
  for (size_t i = 0; i < server->goal_handles_memory_size; ++i) {
    const rclc_action_goal_handle_t * goal = &server->declared->goals[i];

    if (goal->is_used && goal->status != GOAL_STATE_UNKNOWN) {
      server->declared->statuses[count].goal_info.goal_id = goal->goal_id;
      server->declared->statuses[count].goal_info.stamp = goal->stamp;
      server->declared->statuses[count].status = goal->status;
      ++count;
    }
  }
  return count;
}

rcl_ret_t rclc_action_publish_status(rclc_action_server_t * server)
{
  action_msgs__msg__GoalStatusArray message;
  rcl_ret_t result;

  microros_lock();
  message.status_list.data = server->declared->statuses;
  message.status_list.size = action_status_fill(server);
  message.status_list.capacity = server->declared->goals_max;
  server->session = (uint8_t)rmw_client_reconnects();
  result = rcl_publish(&server->rcl_handle.status_publisher, &message, NULL);
  server->status_due = result != RCL_RET_OK;
  microros_unlock();
  return result;
}

/* Returns the position of an active handle of a server that is open; SIZE_MAX: it is none. Called with the lock. */
static size_t action_result_place(const rclc_action_goal_handle_t * goal)
{
  const rclc_action_server_t * server = goal->action_server;

  if (server == NULL || server->declared == NULL || !goal->is_used || rclc_action_has_ended(goal)) {
    return SIZE_MAX;
  }
  /* at most MICROROS_ACTION_SERVER_GOALS rounds */
  for (size_t i = 0; i < server->goal_handles_memory_size; ++i) {
    if (goal == &server->declared->goals[i]) {
      return i;
    }
  }
  return SIZE_MAX;
}

static rcl_action_goal_event_t action_result_event(rcl_action_goal_state_t status)
{
  if (status == GOAL_STATE_SUCCEEDED) {
    return GOAL_EVENT_SUCCEED;
  }
  return status == GOAL_STATE_CANCELED ? GOAL_EVENT_CANCELED : GOAL_EVENT_ABORT;
}

/* Encodes the result to its place. Called with the lock. */
static rcl_ret_t action_result_keep(rclc_action_goal_handle_t * goal, size_t place, const void * ros_response)
{
  const rclc_action_server_t * server = goal->action_server;
  const microros_action_type_t * type = server->type;
  const microros_message_type_t * response = type->result_response->data;
  cdr_fault_t fault; /* set if the message is refused */

  goal->result_size =
    response->encode(ros_response, &server->declared->results[place * server->declared->result_size], &fault);
  return goal->result_size != 0u ? RCL_RET_OK : rmw_encode_refuse(response, &fault);
}

/* Called with the lock. */
static rcl_ret_t action_result_end(
  rclc_action_goal_handle_t * goal, size_t place, rcl_action_goal_state_t status, void * ros_response)
{
  rcl_ret_t result;

  if (goal->status == GOAL_STATE_UNKNOWN || goal->status == GOAL_STATE_ACCEPTED) {
    return RCLC_RET_ACTION_WAIT_RESULT_REQUEST;
  }
  if (rcl_action_transition_goal_state(goal->status, action_result_event(status)) != status) {
    return microros_error_named(
      RCL_RET_ACTION_GOAL_EVENT_INVALID, microros_error_action_goal_state,
      rclc_action_name(goal->action_server));
  }
  (void)memcpy(ros_response, &status, sizeof(status)); /* the first member of every response */
  result = action_result_keep(goal, place, ros_response);
  if (result == RCL_RET_OK) {
    goal->ended_ms = port_time_ms();
    (void)rclc_action_go(goal, action_result_event(status));
  }
  return result;
}

rcl_ret_t rclc_action_send_result(
  rclc_action_goal_handle_t * goal_handle, rcl_action_goal_state_t status, void * ros_response)
{
  rcl_ret_t result;
  size_t place;

  if (
    goal_handle == NULL || ros_response == NULL || status <= GOAL_STATE_CANCELING ||
    status >= GOAL_STATE_NUM_STATES) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handle, status or ros_response");
  }
  microros_lock();
  place = action_result_place(goal_handle);
  result = place == SIZE_MAX ? microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handle")
                             : action_result_end(goal_handle, place, status, ros_response);
  microros_unlock();
  if (result == RCL_RET_OK) {
    microros_wake(); /* the executor sends it */
  }
  return result;
}

rcl_ret_t rclc_action_publish_feedback(rclc_action_goal_handle_t * goal_handle, void * ros_feedback)
{
  const rclc_action_server_t * server;
  size_t place;

  if (goal_handle == NULL || ros_feedback == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handle or ros_feedback");
  }
  microros_lock();
  place = action_result_place(goal_handle);
  server = goal_handle->action_server;
  if (place != SIZE_MAX) {
    /* at most UUID_SIZE bytes */
    (void)memcpy(ros_feedback, goal_handle->goal_id.uuid, UUID_SIZE); /* the first member of every feedback */
  }
  microros_unlock();
  return place == SIZE_MAX ? microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handle")
                           : rcl_publish(&server->rcl_handle.feedback_publisher, ros_feedback, NULL);
}

static bool action_result_is_awaited(const rclc_action_goal_handle_t * goal)
{
  return goal->is_used && goal->waiting != 0u && rclc_action_has_ended(goal);
}

bool rclc_action_has_results(const rclc_action_server_t * server)
{
  bool awaited = false;

  /* at most MICROROS_ACTION_SERVER_GOALS rounds */
  for (size_t i = 0; i < server->goal_handles_memory_size; ++i) {
    awaited = awaited || action_result_is_awaited(&server->declared->goals[i]);
  }
  return awaited && rmw_action_server_may_reply(server->rcl_handle.result_service.impl);
}

/* Called with the lock. */
static void action_result_drop_oldest(rclc_action_goal_handle_t * goal)
{
  --goal->waiting;
  /* at most (MICROROS_ACTION_RESULT_REQUESTS - 1) * 24 bytes: rmw_request_id_t has 24 */
  (void)memmove(
    goal->result_requests, &goal->result_requests[1], goal->waiting * sizeof(goal->result_requests[0]));
}

static rcl_ret_t action_result_send(
  rclc_action_server_t * server, rclc_action_goal_handle_t * goal, size_t place)
{
  const rclc_action_outcome_t outcome = {
    .body = &server->declared->results[place * server->declared->result_size], .size = goal->result_size};
  rcl_ret_t result;

  microros_lock();
  result = rmw_replier_respond(server->rcl_handle.result_service.impl, &goal->result_requests[0], &outcome);
  if (result == RCL_RET_OK) {
    action_result_drop_oldest(goal);
    goal->result_sent = true;
  }
  microros_unlock();
  return result;
}

rcl_ret_t rclc_action_send_results(rclc_action_server_t * server)
{
  rcl_ret_t result = RCL_RET_OK;

  for (size_t i = 0; i < server->goal_handles_memory_size && result == RCL_RET_OK; ++i) {
    rclc_action_goal_handle_t * goal = &server->declared->goals[i];

    while (result == RCL_RET_OK && action_result_is_awaited(goal) &&
           rmw_action_server_may_reply(server->rcl_handle.result_service.impl)) {
      result = action_result_send(server, goal, i);
    }
  }
  return result;
}

/* Called with the lock. */
static rcl_ret_t action_result_wait(
  const rclc_action_server_t * server, rclc_action_goal_handle_t * goal, const rmw_request_id_t * request)
{
  const bool full = goal->waiting == (uint8_t)MICROROS_ACTION_RESULT_REQUESTS;

  if (full) {
    action_result_drop_oldest(goal);
    microros_error_set(
      microros_error_action_results_full, rclc_action_name(server), NULL, MICROROS_ACTION_RESULT_REQUESTS,
      MICROROS_ACTION_RESULT_REQUESTS + 1u);
  }
  goal->result_requests[goal->waiting] = *request;
  ++goal->waiting;
  return full ? RCL_RET_ERROR : RCL_RET_OK;
}

rcl_ret_t rclc_action_serve_result(rclc_action_server_t * server)
{
  const microros_action_type_t * type = server->type;
  const rclc_action_outcome_t unknown = {
    .type = type->result_response->data, .message = server->declared->no_result, .body = NULL};
  uint8_t uuid[UUID_SIZE];
  rmw_service_info_t info;
  bool taken = false;
  rcl_ret_t result = rmw_replier_take(server->rcl_handle.result_service.impl, &info, uuid, &taken);

  if (!taken) {
    return result;
  }
  microros_lock();
  rclc_action_goal_handle_t * goal = rclc_action_find(server, uuid);
  result = goal != NULL && goal->status != GOAL_STATE_UNKNOWN
             ? action_result_wait(server, goal, &info.request_id)
             : rmw_replier_respond(server->rcl_handle.result_service.impl, &info.request_id, &unknown);
  microros_unlock();
  return result;
}
