/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The callbacks of a client: goal, feedback, cancel, result, and then those of goals whose time is over. A callback may
 * send and cancel goals, and finalize the client: then it has no goals left.
 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rclc_action_client.h"
#include "microros/rmw_action_client.h"
#include "microros/rmw_client.h"

#include <string.h>

/* Clears a mark of a goal; returns whether it was set. A callback of the same round may have ended the goal. */
static bool call_unmark(const rclc_action_goal_handle_t * goal, bool * mark)
{
  const bool was_marked = goal->is_used && *mark;

  *mark = false;
  return was_marked;
}

static void call_free(rclc_action_goal_handle_t * goal)
{
  microros_lock();
  if (rclc_action_client_has(goal)) { /* the callback may have finalized the client */
    rclc_action_client_free_place(goal);
  }
  microros_unlock();
}

/* The request for the result follows the callback: it is sent as soon as there is room. */
static void call_goal(const rclc_action_client_t * client, rclc_action_goal_handle_t * goal)
{
  client->goal_callback(goal, goal->goal_accepted, client->context);
  if (!goal->goal_accepted) {
    call_free(goal);
    return;
  }
  microros_lock();
  if (rclc_action_client_has(goal)) {
    goal->status = GOAL_STATE_ACCEPTED;
    goal->since_ms = port_time_ms();
    goal->result_due = !goal->awaits_result_response;
  }
  microros_unlock();
}

static void call_result(const rclc_action_client_t * client, rclc_action_goal_handle_t * goal)
{
  client->result_callback(goal, client->ros_result_response, client->context);
  call_free(goal);
}

static void call_cancel(const rclc_action_client_t * client, rclc_action_goal_handle_t * goal)
{
  if (client->cancel_callback != NULL) {
    client->cancel_callback(goal, goal->goal_cancelled, client->context);
  }
}

/* Sends requests for results as far as there is room. */
static void call_send(rclc_action_client_t * client)
{
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (
      goal->is_used && goal->result_due &&
      rmw_action_client_may_send(client->rcl_handle.result_client.impl)) {
      rclc_action_client_note(client, rclc_action_send_result_request(goal));
    }
  }
}

static void call_marked(rclc_action_client_t * client)
{
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (call_unmark(goal, &goal->available_goal_response)) {
      call_goal(client, goal);
    }
  }
  call_send(client);
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (call_unmark(goal, &goal->available_feedback)) {
      client->feedback_callback(goal, client->ros_feedback, client->context);
    }
  }
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (call_unmark(goal, &goal->available_cancel_response)) {
      call_cancel(client, goal);
    }
  }
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (call_unmark(goal, &goal->available_result_response)) {
      call_result(client, goal);
    }
  }
}

static uint32_t call_left(uint32_t since_ms, uint32_t timeout_ms)
{
  const uint32_t passed_ms = port_time_ms() - since_ms;

  return passed_ms < timeout_ms ? timeout_ms - passed_ms : 0u;
}

static bool call_is_silent(const rclc_action_goal_handle_t * goal, uint32_t timeout_ms)
{
  return goal->is_used && goal->awaits_goal_response && call_left(goal->since_ms, timeout_ms) == 0u;
}

static bool call_is_cancel_silent(const rclc_action_goal_handle_t * goal, uint32_t timeout_ms)
{
  return goal->is_used && goal->awaits_cancel_response && call_left(goal->cancel_ms, timeout_ms) == 0u;
}

static bool call_has_no_result(const rclc_action_goal_handle_t * goal, uint32_t timeout_ms)
{
  return timeout_ms != 0u && goal->is_used && goal->status == GOAL_STATE_ACCEPTED &&
         call_left(goal->since_ms, timeout_ms) == 0u;
}

static void call_report(rclc_action_client_t * client, microros_error_t error, uint32_t timeout_ms)
{
  microros_error_set(error, rclc_action_client_name(client), NULL, timeout_ms, 0);
  rclc_action_client_note(client, RCL_RET_ERROR);
}

/* A callback may replace the text. */
static void call_expired(rclc_action_client_t * client, rclc_action_goal_handle_t * goal)
{
  static const rcl_action_goal_state_t unknown = GOAL_STATE_UNKNOWN;
  const uint32_t response_ms = client->declared->response_timeout_ms;
  const uint32_t result_ms = client->declared->result_timeout_ms;

  if (call_is_silent(goal, response_ms)) {
    call_report(client, microros_error_action_client_silent, response_ms);
    goal->goal_accepted = false;
    call_goal(client, goal);
  } else if (call_has_no_result(goal, result_ms)) {
    call_report(client, microros_error_action_client_result, result_ms);
    (void)memcpy(
      client->ros_result_response, &unknown, sizeof(unknown)); /* the first member of every response */
    call_result(client, goal);
  } else if (call_is_cancel_silent(goal, response_ms)) {
    call_report(client, microros_error_action_client_silent, response_ms);
    goal->awaits_cancel_response = false;
    rmw_action_client_abandon(client->rcl_handle.cancel_client.impl, goal->cancel_request_sequence_number);
    goal->goal_cancelled = false;
    call_cancel(client, goal);
  } else {
    /* it has time left */
  }
}

/* The status is `accepted` only when the response came: then the time of the result runs. */
static uint32_t call_goal_left(
  const rclc_action_goal_handle_t * goal, uint32_t response_ms, uint32_t result_ms)
{
  if (goal->awaits_goal_response) {
    return call_left(goal->since_ms, response_ms);
  }
  return goal->status == GOAL_STATE_ACCEPTED && result_ms != 0u ? call_left(goal->since_ms, result_ms)
                                                                : UINT32_MAX;
}

uint32_t rclc_action_client_left(const rclc_action_client_t * client)
{
  const uint32_t response_ms = client->declared->response_timeout_ms;
  uint32_t left = UINT32_MAX;

  /* at most MICROROS_REQUESTS_MAX / 3 rounds */
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    const rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (goal->is_used) {
      const uint32_t due = call_goal_left(goal, response_ms, client->declared->result_timeout_ms);
      const uint32_t cancel =
        goal->awaits_cancel_response ? call_left(goal->cancel_ms, response_ms) : UINT32_MAX;

      left = due < left ? due : left;
      left = cancel < left ? cancel : left;
    }
  }
  return left;
}

bool rclc_action_client_has_due(const rclc_action_client_t * client)
{
  const rmw_client_t * results = client->rcl_handle.result_client.impl;
  bool is_due =
    (uint8_t)rmw_client_reconnects() != client->session || rmw_action_client_drops(results) != client->drops;

  /* at most MICROROS_REQUESTS_MAX / 3 rounds */
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    const rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    is_due = is_due || (goal->is_used && goal->result_due);
  }
  return is_due && rmw_action_client_may_send(results);
}

void rclc_action_client_call(rclc_action_client_t * client)
{
  call_marked(client);
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    call_expired(client, goal);
  }
  call_send(client);
}
