/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/rmw_service.h"

#include <stddef.h>

static rcl_ret_t client_refuse(void)
{
  return microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
}

static rcl_ret_t client_look(const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  (void)look_again_ns; /* a reply wakes the executor */
  if (!rcl_client_is_valid(handle->client)) {
    return client_refuse();
  }
  *is_ready = rmw_requester_is_ready(handle->client->impl);
  return RCL_RET_OK;
}

static rcl_ret_t client_take(rclc_executor_handle_t * handle)
{
  rmw_service_info_t info;
  rmw_ret_t result;

  if (!rcl_client_is_valid(handle->client)) {
    return client_refuse();
  }
  result = rmw_requester_take(handle->client->impl, &info, handle->data, &handle->data_available);
  if (handle->data_available) {
    handle->req_id = info.request_id;
  }
  return result;
}

static rcl_ret_t client_call(rclc_executor_handle_t * handle)
{
  handle->callback.client(handle->data);
  return RCL_RET_OK;
}

static rcl_ret_t client_call_with_request_id(rclc_executor_handle_t * handle)
{
  rmw_request_id_t request_id = handle->req_id; /* copied: the callback may remove the handle */

  handle->callback.client_with_request_id(handle->data, &request_id);
  return RCL_RET_OK;
}

/* Returns a handle without its callback, or NULL. */
static rclc_executor_handle_t * client_add(
  rclc_executor_t * executor, rcl_client_t * client, void * response_msg, rclc_executor_handle_type_t type,
  const rclc_handle_kind_t * kind)
{
  rclc_executor_handle_t * handle = rclc_executor_add_handle(executor, type, kind);

  if (handle != NULL) {
    handle->client = client;
    handle->data = response_msg;
    ++executor->info.number_of_clients;
    if (rcl_client_is_valid(client)) {
      rmw_requester_bind(client->impl, response_msg);
    }
  }
  return handle;
}

rcl_ret_t rclc_executor_add_client(
  rclc_executor_t * executor, rcl_client_t * client, void * response_msg, rclc_client_callback_t callback)
{
  static const rclc_handle_kind_t kind = {client_look, client_take, client_call};
  rclc_executor_handle_t * handle;

  if (executor == NULL || client == NULL || response_msg == NULL || callback == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor, client, response_msg or callback");
  }
  handle = client_add(executor, client, response_msg, RCLC_CLIENT, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->callback.client = callback;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_add_client_with_request_id(
  rclc_executor_t * executor, rcl_client_t * client, void * response_msg,
  rclc_client_callback_with_request_id_t callback)
{
  static const rclc_handle_kind_t kind = {client_look, client_take, client_call_with_request_id};
  rclc_executor_handle_t * handle;

  if (executor == NULL || client == NULL || response_msg == NULL || callback == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor, client, response_msg or callback");
  }
  handle = client_add(executor, client, response_msg, RCLC_CLIENT_WITH_REQUEST_ID, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->callback.client_with_request_id = callback;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_client(rclc_executor_t * executor, const rcl_client_t * client)
{
  const rcl_ret_t result = rclc_executor_remove_handle(executor, client);

  if (result == RCL_RET_OK) {
    --executor->info.number_of_clients;
  }
  return result;
}
