/* SPDX-License-Identifier: Apache-2.0 */
/* The places of goals, and what the application asks of a server. Places are used with the lock. */
#include "action_msgs/srv/cancel_goal.h"
#include "microros/epoch.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rclc_action_client.h"
#include "microros/rmw_action_client.h"
#include "microros/rmw_client.h"
#include "microros/rmw_service.h"

#include <string.h>

rclc_action_goal_handle_t * rclc_action_client_find(const rclc_action_client_t * client, const uint8_t * uuid)
{
  /* at most MICROROS_REQUESTS_MAX / 3 rounds */
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (goal->is_used && memcmp(goal->goal_id.uuid, uuid, UUID_SIZE) == 0) {
      return goal;
    }
  }
  return NULL;
}

static void request_put_4(uint8_t * to, uint32_t number)
{
  to[0] = (uint8_t)(number >> 24);
  to[1] = (uint8_t)(number >> 16 & UINT8_MAX);
  to[2] = (uint8_t)(number >> 8 & UINT8_MAX);
  to[3] = (uint8_t)(number & UINT8_MAX);
}

/*
 * Device, time of day, time since the start, and number of the goal. A server refuses an id that it still knows: a board
 * without the time of day would have to send a goal in the same millisecond after its start.
 */
static void request_identify(uint8_t * uuid)
{
  static uint32_t goals_sent; /* of all clients */
  const uint64_t epoch_ns = (uint64_t)microros_epoch_known_ns();

  ++goals_sent;
  request_put_4(&uuid[0], rmw_client_key());
  request_put_4(&uuid[4], (uint32_t)(epoch_ns >> 16 & UINT32_MAX));
  request_put_4(&uuid[8], port_time_ms());
  request_put_4(&uuid[12], goals_sent);
}

rclc_action_goal_handle_t * rclc_action_client_take_place(rclc_action_client_t * client)
{
  for (size_t i = 0; i < client->goals_at_once; ++i) { /* at most MICROROS_REQUESTS_MAX / 3 rounds */
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (!goal->is_used) {
      (void)memset(goal, 0, sizeof(*goal));
      goal->action_client = client;
      goal->is_used = true;
      request_identify(goal->goal_id.uuid);
      return goal;
    }
  }
  return NULL;
}

void rclc_action_client_free_place(rclc_action_goal_handle_t * goal)
{
  const rcl_action_client_t * opened = &goal->action_client->rcl_handle;

  goal->is_used = false;
  if (goal->awaits_goal_response) {
    rmw_action_client_abandon(opened->goal_client.impl, goal->goal_request_sequence_number);
  }
  if (goal->awaits_result_response) {
    rmw_action_client_abandon(opened->result_client.impl, goal->result_request_sequence_number);
  }
  if (goal->awaits_cancel_response) {
    rmw_action_client_abandon(opened->cancel_client.impl, goal->cancel_request_sequence_number);
  }
}

bool rclc_action_client_has(const rclc_action_goal_handle_t * goal)
{
  return goal->is_used && goal->action_client != NULL && goal->action_client->declared != NULL;
}

/* Called with the lock. */
static rcl_ret_t request_goal(
  rclc_action_client_t * client, void * ros_request, rclc_action_goal_handle_t ** goal_handle)
{
  rclc_action_goal_handle_t * goal = rclc_action_client_take_place(client);
  uint8_t * request = ros_request;
  rcl_ret_t result;

  if (goal == NULL) {
    const uint32_t goals = client->goals_at_once;

    microros_error_set(
      microros_error_action_client_goals, rclc_action_client_name(client), NULL, goals, goals + 1u);
    return RCL_RET_ERROR;
  }
  goal->ros_goal_request = (void *)&request[0];
  goal->since_ms = port_time_ms();
  /* at most UUID_SIZE bytes */
  (void)memcpy(request, goal->goal_id.uuid, UUID_SIZE); /* the first member of every request */
  result =
    rmw_requester_send(client->rcl_handle.goal_client.impl, ros_request, &goal->goal_request_sequence_number);
  goal->awaits_goal_response = result == RCL_RET_OK;
  goal->is_used = goal->awaits_goal_response;
  if (goal->is_used && goal_handle != NULL) {
    *goal_handle = goal;
  }
  return goal->is_used ? RCL_RET_OK : RCL_RET_ERROR;
}

rcl_ret_t rclc_action_send_goal_request(
  rclc_action_client_t * action_client, void * ros_request, rclc_action_goal_handle_t ** goal_handle)
{
  rcl_ret_t result;

  if (action_client == NULL || ros_request == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "action_client or ros_request");
  }
  microros_lock();
  result = action_client->goal_handles_memory_size != 0u
             ? request_goal(action_client, ros_request, goal_handle)
             : microros_error_named(RCL_RET_ERROR, microros_error_action_client_closed, NULL);
  microros_unlock();
  return result;
}

/* Called with the lock. */
static rcl_ret_t request_result(rclc_action_goal_handle_t * goal)
{
  const rmw_client_t * client = goal->action_client->rcl_handle.result_client.impl;
  rcl_ret_t result;

  if (goal->awaits_result_response) {
    rmw_action_client_abandon(client, goal->result_request_sequence_number);
    goal->awaits_result_response = false;
    goal->result_due = true; /* the executor asks again if this request cannot be sent */
  }
  result = rmw_requester_send(client, goal->goal_id.uuid, &goal->result_request_sequence_number);
  goal->awaits_result_response = result == RCL_RET_OK;
  goal->result_due = goal->result_due && result != RCL_RET_OK;
  return result;
}

rcl_ret_t rclc_action_send_result_request(rclc_action_goal_handle_t * goal_handle)
{
  rcl_ret_t result;

  if (goal_handle == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handle");
  }
  microros_lock();
  result = rclc_action_client_has(goal_handle)
             ? request_result(goal_handle)
             : microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handle");
  microros_unlock();
  return result;
}

/* Called with the lock. */
static rcl_ret_t request_cancel(rclc_action_goal_handle_t * goal)
{
  const rmw_client_t * client = goal->action_client->rcl_handle.cancel_client.impl;
  action_msgs__srv__CancelGoal_Request request;
  int64_t sequence_number;
  rcl_ret_t result;

  (void)memset(&request, 0, sizeof(request)); /* without a time: this goal alone */
  request.goal_info.goal_id = goal->goal_id;
  if (goal->awaits_cancel_response && rmw_action_client_may_send(client)) {
    rmw_action_client_abandon(client, goal->cancel_request_sequence_number);
  }
  result = rmw_requester_send(client, &request, &sequence_number);
  if (result != RCL_RET_OK) {
    return result;
  }
  goal->cancel_request_sequence_number = sequence_number;
  goal->cancel_ms = port_time_ms();
  goal->awaits_cancel_response = true;
  return RCL_RET_OK;
}

rcl_ret_t rclc_action_send_cancel_request(rclc_action_goal_handle_t * goal_handle)
{
  rcl_ret_t result;

  if (goal_handle == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handle");
  }
  microros_lock();
  result = rclc_action_client_has(goal_handle)
             ? request_cancel(goal_handle)
             : microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_handle");
  microros_unlock();
  return result;
}
