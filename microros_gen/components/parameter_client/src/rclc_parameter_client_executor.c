/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/rclc_parameter_client.h"

enum { PARAMETER_CLIENT_NS_PER_MS = 1000000 };

static rcl_ret_t parameter_client_look(
  const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  rclc_parameter_client_t * client = handle->callback_context;

  if (!rcl_client_is_valid(handle->client)) {
    return microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
  }
  *is_ready = rclc_parameter_client_is_due(client) || rclc_parameter_client_has_event(client);
  if (client->is_busy) {
    const int64_t left_ns = (int64_t)rclc_parameter_client_left_ms(client) * PARAMETER_CLIENT_NS_PER_MS;

    *look_again_ns = left_ns < *look_again_ns ? left_ns : *look_again_ns;
  }
  return RCL_RET_OK;
}

/* One event per round: its callback may finalize the client. */
static rcl_ret_t parameter_client_call(rclc_executor_handle_t * handle)
{
  rclc_parameter_client_t * client = handle->callback_context;
  rcl_ret_t result;

  if (rclc_parameter_client_is_due(client)) {
    if (rclc_parameter_client_is_done(client, &result)) {
      client->callback(client, result, client->context);
    }
  } else {
    rclc_parameter_client_take_event(client);
  }
  return RCL_RET_OK;
}

/* Without an executor an asynchronous call would never end: only the waiting forms are possible. */
static rcl_client_t * parameter_client_service(rclc_parameter_client_t * client)
{
  for (uint32_t i = 0; i < (uint32_t)RCLC_PARAMETER_CLIENT_CALLS; ++i) {
    if (rcl_client_is_valid(&client->services[i])) {
      return &client->services[i];
    }
  }
  return NULL;
}

rcl_ret_t rclc_executor_add_parameter_client(rclc_executor_t * executor, rclc_parameter_client_t * client)
{
  static const rclc_handle_kind_t kind = {
    parameter_client_look, rclc_handle_take_nothing, parameter_client_call};
  rclc_executor_handle_t * handle;

  if (executor == NULL || client == NULL || parameter_client_service(client) == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client or executor");
  }
  if (client->executor != NULL) {
    return rclc_parameter_client_refuse(
      client, RCL_RET_ERROR, MICROROS_ERROR_WORDS("an executor runs the client already"));
  }
  if (!rclc_parameter_client_may_watch(client, executor)) {
    return RCL_RET_ERROR;
  }
  handle = rclc_executor_add_handle(executor, RCLC_CLIENT, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->client = parameter_client_service(client);
  handle->callback_context = client;
  ++executor->info.number_of_clients;
  client->executor = executor;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_parameter_client(rclc_executor_t * executor, rclc_parameter_client_t * client)
{
  rcl_ret_t result;

  if (client == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client");
  }
  result = rclc_executor_remove_client(executor, parameter_client_service(client));
  if (result == RCL_RET_OK) {
    client->executor = NULL;
    client->is_calling = false;
  }
  return result;
}
