/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/lock.h"
#include "microros/rclc_action_client.h"
#include "microros/rmw_service.h"
#include "microros/rmw_subscription.h"

enum { ACTION_CLIENT_NS_PER_MS = 1000000 };

static rcl_ret_t action_client_check(const rclc_executor_handle_t * handle)
{
  const rclc_action_client_t * client = handle->callback_context;

  return client->declared != NULL ? RCL_RET_OK
                                  : microros_error_refuse(RCL_RET_ACTION_CLIENT_INVALID, "action_client");
}

static rcl_ret_t action_client_look(
  const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  const rclc_action_client_t * client = handle->callback_context;
  const rcl_action_client_t * opened = &client->rcl_handle;
  uint32_t left_ms;

  if (action_client_check(handle) != RCL_RET_OK) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  microros_lock();
  left_ms = rclc_action_client_left(client);
  *is_ready = left_ms == 0u || rclc_action_client_has_due(client) ||
              rmw_requester_is_ready(opened->goal_client.impl) ||
              rmw_requester_is_ready(opened->cancel_client.impl) ||
              rmw_requester_is_ready(opened->result_client.impl) ||
              rmw_subscription_is_ready(opened->feedback_subscription.impl);
  microros_unlock();
  if (left_ms != UINT32_MAX && (int64_t)left_ms * ACTION_CLIENT_NS_PER_MS < *look_again_ns) {
    *look_again_ns = (int64_t)left_ms * ACTION_CLIENT_NS_PER_MS;
  }
  return RCL_RET_OK;
}

/* A fault is reported with the callbacks of what else was taken. */
static rcl_ret_t action_client_take(rclc_executor_handle_t * handle)
{
  const rcl_ret_t result = action_client_check(handle);

  if (result == RCL_RET_OK) {
    rclc_action_client_take(handle->callback_context);
  }
  return result;
}

static rcl_ret_t action_client_call(rclc_executor_handle_t * handle)
{
  rclc_action_client_t * client = handle->callback_context;
  rcl_ret_t result = action_client_check(handle);

  if (result == RCL_RET_OK) {
    rclc_action_client_call(client);
    result = client->fault;
    client->fault = RCL_RET_OK;
  }
  return result;
}

static rcl_ret_t action_client_fits(const rclc_action_client_t * client, size_t goals)
{
  if (goals <= client->declared->goals_max) {
    return RCL_RET_OK;
  }
  microros_error_set(
    microros_error_action_client_goals, rclc_action_client_name(client), NULL, client->declared->goals_max,
    (uint32_t)goals);
  return RCL_RET_ERROR;
}

/* Goals that are active when a client is added again end as they would have, also beyond its new places. */
static void action_client_size(rclc_action_client_t * client, size_t goals)
{
  const rclc_action_client_declared_t * declared = client->declared;

  microros_lock();
  client->goals_at_once = (uint16_t)goals;
  client->goal_handles_memory_size = goals;
  for (size_t i = goals; i < declared->goals_max; ++i) {
    if (declared->goals[i].is_used && declared->goals[i].action_client == client) {
      client->goal_handles_memory_size = i + 1u;
    }
  }
  microros_unlock();
}

static void action_client_bind(rclc_action_client_t * client)
{
  rmw_requester_bind(client->rcl_handle.result_client.impl, client->ros_result_response);
  if (client->ros_feedback != NULL) {
    rmw_subscription_bind(client->rcl_handle.feedback_subscription.impl, client->ros_feedback);
  }
}

rcl_ret_t rclc_executor_add_action_client(
  rclc_executor_t * executor, rclc_action_client_t * action_client, size_t handles_number,
  void * ros_result_response, void * ros_feedback, rclc_action_client_goal_callback_t goal_callback,
  rclc_action_client_feedback_callback_t feedback_callback,
  rclc_action_client_result_callback_t result_callback, rclc_action_client_cancel_callback_t cancel_callback,
  void * context)
{
  static const rclc_handle_kind_t kind = {action_client_look, action_client_take, action_client_call};
  rclc_executor_handle_t * handle;
  rcl_ret_t result;

  if (
    executor == NULL || action_client == NULL || action_client->declared == NULL || handles_number == 0u ||
    ros_result_response == NULL || goal_callback == NULL || result_callback == NULL ||
    (feedback_callback != NULL && ros_feedback == NULL)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor, action_client, messages or callbacks");
  }
  result = action_client_fits(action_client, handles_number);
  if (result != RCL_RET_OK) {
    return result;
  }
  handle = rclc_executor_add_handle(executor, RCLC_ACTION_CLIENT, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->client = &action_client->rcl_handle.goal_client;
  handle->callback_context = action_client;
  action_client->ros_result_response = ros_result_response;
  action_client->ros_feedback = ros_feedback;
  action_client->goal_callback = goal_callback;
  action_client->feedback_callback = feedback_callback;
  action_client->result_callback = result_callback;
  action_client->cancel_callback = cancel_callback;
  action_client->context = context;
  action_client_size(action_client, handles_number);
  action_client_bind(action_client);
  ++executor->info.number_of_action_clients;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_action_client(rclc_executor_t * executor, rclc_action_client_t * action_client)
{
  rcl_ret_t result;

  if (action_client == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "action_client");
  }
  result = rclc_executor_remove_handle(executor, &action_client->rcl_handle.goal_client);
  if (result == RCL_RET_OK) {
    --executor->info.number_of_action_clients;
  }
  return result;
}
