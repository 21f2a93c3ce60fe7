/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/lock.h"
#include "microros/rclc_action_server.h"
#include "microros/rmw_service.h"

#include <string.h>

enum { ACTION_SERVER_NS_PER_MS = 1000000 };

static rcl_ret_t action_server_look(
  const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  const rclc_action_server_t * server = handle->callback_context;
  uint32_t left_ms;

  if (!rcl_service_is_valid(handle->service)) {
    return microros_error_refuse(RCL_RET_SERVICE_INVALID, "action_server");
  }
  microros_lock();
  left_ms = rclc_action_expire(server, false);
  *is_ready = left_ms == 0u || rclc_action_has_status(server) || rclc_action_has_results(server) ||
              rmw_replier_is_ready(server->rcl_handle.goal_service.impl) ||
              rmw_replier_is_ready(server->rcl_handle.cancel_service.impl) ||
              rmw_replier_is_ready(server->rcl_handle.result_service.impl);
  microros_unlock();
  if (left_ms != UINT32_MAX && (int64_t)left_ms * ACTION_SERVER_NS_PER_MS < *look_again_ns) {
    *look_again_ns = (int64_t)left_ms * ACTION_SERVER_NS_PER_MS;
  }
  return RCL_RET_OK;
}

/* Keeps the first error; the others are in their counters. */
static void action_server_note(rcl_ret_t * first, rcl_ret_t result)
{
  if (*first == RCL_RET_OK) {
    *first = result;
  }
}

static void action_server_send(rclc_action_server_t * server, rcl_ret_t * first)
{
  if (rclc_action_has_status(server)) {
    action_server_note(first, rclc_action_publish_status(server));
  }
  action_server_note(first, rclc_action_send_results(server));
}

/* Results have the first turn, so that a new goal finds their places. A callback may finalize the server. */
static rcl_ret_t action_server_call(rclc_executor_handle_t * handle)
{
  rclc_action_server_t * server = handle->callback_context;
  rcl_ret_t result = RCL_RET_OK;

  if (!rcl_service_is_valid(&server->rcl_handle.goal_service)) {
    return microros_error_refuse(RCL_RET_SERVICE_INVALID, "action_server");
  }
  action_server_note(&result, rclc_action_serve_result(server));
  action_server_send(server, &result);
  microros_lock();
  (void)rclc_action_expire(server, true);
  microros_unlock();
  action_server_note(&result, rclc_action_serve_goal(server));
  if (rcl_service_is_valid(&server->rcl_handle.cancel_service)) {
    action_server_note(&result, rclc_action_serve_cancel(server));
  }
  if (rcl_service_is_valid(&server->rcl_handle.goal_service)) {
    action_server_send(server, &result);
  }
  return result;
}

/* Goals that are active when a server is added again end as they would have, also beyond its new places. Called with the
 * lock. */
static void action_server_size(rclc_action_server_t * server, size_t goals)
{
  const rclc_action_declared_t * declared = server->declared;

  server->goals_at_once = (uint16_t)goals;
  server->goal_handles_memory_size = goals;
  for (size_t i = goals; i < declared->goals_max; ++i) {
    if (declared->goals[i].is_used && declared->goals[i].action_server == server) {
      server->goal_handles_memory_size = i + 1u;
    }
  }
}

static void action_server_place_goals(rclc_action_server_t * server, size_t goals, void * requests)
{
  const rclc_action_declared_t * declared = server->declared;
  uint8_t * request = requests;

  microros_lock();
  for (size_t i = 0; i < goals; ++i) {
    if (declared->bind != NULL) {
      declared->bind(requests, i);
    }
    declared->goals[i].action_server = server;
    declared->goals[i].ros_goal_request = (void *)&request[i * declared->request_size];
  }
  action_server_size(server, goals);
  microros_unlock();
}

/* Returns the code of what is wrong with the memory of the goals. */
static rcl_ret_t action_server_check(const rclc_action_server_t * server, size_t goals, size_t request_size)
{
  if (goals > server->declared->goals_max) {
    microros_error_set(
      microros_error_action_server_goals, rclc_action_name(server), NULL, (uint32_t)goals,
      server->declared->goals_max);
    return RCL_RET_ERROR;
  }
  if (request_size != server->declared->request_size) {
    microros_error_set(
      microros_error_action_server_request, rclc_action_name(server), NULL, (uint32_t)request_size,
      server->declared->request_size);
    return RCL_RET_ERROR;
  }
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_add_action_server(
  rclc_executor_t * executor, rclc_action_server_t * action_server, size_t handles_number,
  void * ros_goal_request, size_t ros_goal_request_size,
  rclc_action_server_handle_goal_callback_t goal_callback,
  rclc_action_server_handle_cancel_callback_t cancel_callback, void * context)
{
  static const rclc_handle_kind_t kind = {action_server_look, rclc_handle_take_nothing, action_server_call};
  rclc_executor_handle_t * handle;
  rcl_ret_t result;

  if (
    executor == NULL || action_server == NULL || action_server->declared == NULL || handles_number == 0u ||
    ros_goal_request == NULL || goal_callback == NULL || cancel_callback == NULL) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "executor, action_server, ros_goal_request or callbacks");
  }
  result = action_server_check(action_server, handles_number, ros_goal_request_size);
  if (result != RCL_RET_OK) {
    return result;
  }
  handle = rclc_executor_add_handle(executor, RCLC_ACTION_SERVER, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->service = &action_server->rcl_handle.goal_service;
  handle->callback_context = action_server;
  action_server->goal_callback = goal_callback;
  action_server->cancel_callback = cancel_callback;
  action_server->context = context;
  action_server_place_goals(action_server, handles_number, ros_goal_request);
  ++executor->info.number_of_action_servers;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_action_server(rclc_executor_t * executor, rclc_action_server_t * action_server)
{
  rcl_ret_t result;

  if (action_server == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "action_server");
  }
  result = rclc_executor_remove_handle(executor, &action_server->rcl_handle.goal_service);
  if (result == RCL_RET_OK) {
    --executor->info.number_of_action_servers;
  }
  return result;
}
