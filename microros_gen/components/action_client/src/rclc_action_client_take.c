/* SPDX-License-Identifier: Apache-2.0 */
/* What arrived for a client: messages are taken before callbacks run, as rclc does it. */
#include "action_msgs/srv/cancel_goal.h"
#include "microros/lock.h"
#include "microros/rclc_action_client.h"
#include "microros/rmw_action_client.h"
#include "microros/rmw_client.h"
#include "microros/rmw_service.h"
#include "microros/rmw_subscription.h"

#include <string.h>

void rclc_action_client_note(rclc_action_client_t * client, rcl_ret_t result)
{
  if (client->fault == RCL_RET_OK) {
    client->fault = result;
  }
}

/* The agent's requesters of the last session are gone, and dropped requests were not sent: what they asked for has to be
 * asked for again. */
static void take_session(rclc_action_client_t * client)
{
  const rmw_client_t * results = client->rcl_handle.result_client.impl;
  const uint8_t session = (uint8_t)rmw_client_reconnects();
  const bool is_new = session != client->session;
  const uint32_t drops = rmw_action_client_drops(results);

  if (!is_new && drops == client->drops) {
    return;
  }
  client->session = session;
  client->drops = drops;
  /* at most MICROROS_REQUESTS_MAX / 3 rounds */
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (
      goal->is_used && goal->awaits_result_response &&
      (is_new || !rmw_action_client_expects(results, goal->result_request_sequence_number))) {
      rmw_action_client_abandon(results, goal->result_request_sequence_number);
      goal->awaits_result_response = false;
      goal->result_due = true;
    }
  }
}

static void take_goal_response(rclc_action_client_t * client)
{
  rmw_service_info_t info;
  bool accepted = false;
  bool taken = false;

  rclc_action_client_note(
    client, rmw_requester_take(client->rcl_handle.goal_client.impl, &info, &accepted, &taken));
  /* at most MICROROS_REQUESTS_MAX / 3 rounds */
  for (size_t i = 0; taken && i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (
      goal->is_used && goal->awaits_goal_response &&
      goal->goal_request_sequence_number == info.request_id.sequence_number) {
      goal->awaits_goal_response = false;
      goal->available_goal_response = true;
      goal->goal_accepted = accepted;
    }
  }
}

/* Feedback of goals of other clients is not decoded. */
static void take_feedback(rclc_action_client_t * client)
{
  const rmw_subscription_t * subscription = client->rcl_handle.feedback_subscription.impl;

  while (rmw_subscription_is_ready(subscription)) { /* at most MICROROS_QUEUE_SLOTS + 2 rounds */
    uint8_t uuid[UUID_SIZE];
    const bool has_id = rmw_action_client_peek(subscription, uuid, UUID_SIZE);
    rclc_action_goal_handle_t * goal = has_id ? rclc_action_client_find(client, uuid) : NULL;
    bool taken = false;

    if (!has_id && client->ros_feedback == NULL) { /* too short, and nothing to decode it into */
      rclc_action_client_note(client, rmw_action_client_drop(subscription));
      continue;
    }
    if (!has_id || (goal != NULL && client->feedback_callback != NULL)) {
      rclc_action_client_note(client, rmw_subscription_take(subscription, client->ros_feedback, &taken));
      if (taken && goal != NULL) {
        goal->available_feedback = true;
      }
      return;
    }
    rclc_action_client_note(client, rmw_action_client_drop(subscription));
  }
}

static bool take_is_canceling(
  const action_msgs__srv__CancelGoal_Response * response, const rclc_action_goal_handle_t * goal)
{
  for (size_t i = 0; i < response->goals_canceling.size; ++i) { /* at most MICROROS_REQUESTS_MAX / 3 rounds */
    if (memcmp(response->goals_canceling.data[i].goal_id.uuid, goal->goal_id.uuid, UUID_SIZE) == 0) {
      return true;
    }
  }
  return false;
}

static void take_cancel_response(rclc_action_client_t * client)
{
  action_msgs__srv__CancelGoal_Response response;
  rmw_service_info_t info;
  bool taken = false;

  response.goals_canceling.data = client->declared->canceling;
  response.goals_canceling.size = 0u;
  response.goals_canceling.capacity = client->declared->goals_max;
  rclc_action_client_note(
    client, rmw_requester_take(client->rcl_handle.cancel_client.impl, &info, &response, &taken));
  /* at most MICROROS_REQUESTS_MAX / 3 rounds */
  for (size_t i = 0; taken && i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (
      goal->is_used && goal->awaits_cancel_response &&
      goal->cancel_request_sequence_number == info.request_id.sequence_number) {
      goal->awaits_cancel_response = false;
      goal->available_cancel_response = true;
      goal->goal_cancelled = take_is_canceling(&response, goal);
    }
  }
}

static void take_result_response(rclc_action_client_t * client)
{
  rmw_service_info_t info;
  bool taken = false;

  rclc_action_client_note(
    client,
    rmw_requester_take(client->rcl_handle.result_client.impl, &info, client->ros_result_response, &taken));
  /* at most MICROROS_REQUESTS_MAX / 3 rounds */
  for (size_t i = 0; taken && i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (
      goal->is_used && goal->awaits_result_response &&
      goal->result_request_sequence_number == info.request_id.sequence_number) {
      goal->awaits_result_response = false;
      goal->available_result_response = true;
    }
  }
}

void rclc_action_client_take(rclc_action_client_t * client)
{
  microros_lock();
  take_session(client);
  take_goal_response(client);
  take_feedback(client);
  take_cancel_response(client);
  take_result_response(client);
  microros_unlock();
}
