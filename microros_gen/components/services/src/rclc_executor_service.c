/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/rmw_peer_service.h"
#include "microros/rmw_service.h"

#include <stddef.h>

static rcl_ret_t service_refuse(void)
{
  return microros_error_refuse(RCL_RET_SERVICE_INVALID, "service");
}

static rcl_ret_t service_look(const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  (void)look_again_ns; /* a request wakes the executor */
  if (!rcl_service_is_valid(handle->service)) {
    return service_refuse();
  }
  *is_ready = rmw_replier_is_ready(handle->service->impl);
  return RCL_RET_OK;
}

/*
 * Copy of a handle for the call, since the handle may be reused when the callback returns. A request is
 * taken directly before its callback, whatever the semantics: a handle removed before that leaves it in
 * the queue of its service.
 */
typedef struct service_call_t {
  const rcl_service_t * service;
  void * response;
  rmw_request_id_t request_id;
  bool taken;
} service_call_t;

static rcl_ret_t service_begin(const rclc_executor_handle_t * handle, service_call_t * call)
{
  call->service = handle->service;
  call->response = handle->data_response_msg;
  call->taken = false;
  if (!rcl_service_is_valid(handle->service)) {
    return service_refuse();
  }
  return rmw_replier_begin(handle->service->impl, &call->request_id, handle->data, &call->taken);
}

static rcl_ret_t service_end(const service_call_t * call)
{
  if (!rcl_service_is_valid(call->service)) {
    if (!rmw_peer_abandon(&call->request_id)) {
      rmw_replier_abandon();
    }
    return service_refuse(); /* the callback has finalized it */
  }
  return rmw_replier_end(call->service->impl, &call->request_id, call->response);
}

static rcl_ret_t service_call(rclc_executor_handle_t * handle)
{
  service_call_t call;
  const rcl_ret_t result = service_begin(handle, &call);

  if (!call.taken) {
    return result;
  }
  handle->callback.service(handle->data, call.response);
  return service_end(&call);
}

static rcl_ret_t service_call_with_request_id(rclc_executor_handle_t * handle)
{
  service_call_t call;
  const rcl_ret_t result = service_begin(handle, &call);

  if (!call.taken) {
    return result;
  }
  handle->callback.service_with_request_id(handle->data, &call.request_id, call.response);
  return service_end(&call);
}

static rcl_ret_t service_call_with_context(rclc_executor_handle_t * handle)
{
  service_call_t call;
  const rcl_ret_t result = service_begin(handle, &call);

  if (!call.taken) {
    return result;
  }
  handle->callback.service_with_context(handle->data, call.response, handle->callback_context);
  return service_end(&call);
}

/* Returns a handle without its callback, or NULL. */
static rclc_executor_handle_t * service_add(
  rclc_executor_t * executor, rcl_service_t * service, void * request_msg, void * response_msg,
  rclc_executor_handle_type_t type, const rclc_handle_kind_t * kind)
{
  rclc_executor_handle_t * handle = rclc_executor_add_handle(executor, type, kind);

  if (handle != NULL) {
    handle->service = service;
    handle->data = request_msg;
    handle->data_response_msg = response_msg;
    ++executor->info.number_of_services;
    rmw_replier_bind(service->impl, request_msg, response_msg);
  }
  return handle;
}

static rcl_ret_t service_refuse_argument(void)
{
  return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor, service, messages or callback");
}

rcl_ret_t rclc_executor_add_service(
  rclc_executor_t * executor, rcl_service_t * service, void * request_msg, void * response_msg,
  rclc_service_callback_t callback)
{
  static const rclc_handle_kind_t kind = {service_look, rclc_handle_take_nothing, service_call};
  rclc_executor_handle_t * handle;

  if (
    executor == NULL || service == NULL || request_msg == NULL || response_msg == NULL || callback == NULL) {
    return service_refuse_argument();
  }
  handle = service_add(executor, service, request_msg, response_msg, RCLC_SERVICE, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->callback.service = callback;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_add_service_with_request_id(
  rclc_executor_t * executor, rcl_service_t * service, void * request_msg, void * response_msg,
  rclc_service_callback_with_request_id_t callback)
{
  static const rclc_handle_kind_t kind = {
    service_look, rclc_handle_take_nothing, service_call_with_request_id};
  rclc_executor_handle_t * handle;

  if (
    executor == NULL || service == NULL || request_msg == NULL || response_msg == NULL || callback == NULL) {
    return service_refuse_argument();
  }
  handle = service_add(executor, service, request_msg, response_msg, RCLC_SERVICE_WITH_REQUEST_ID, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->callback.service_with_request_id = callback;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_add_service_with_context(
  rclc_executor_t * executor, rcl_service_t * service, void * request_msg, void * response_msg,
  rclc_service_callback_with_context_t callback, void * context)
{
  static const rclc_handle_kind_t kind = {service_look, rclc_handle_take_nothing, service_call_with_context};
  rclc_executor_handle_t * handle;

  if (
    executor == NULL || service == NULL || request_msg == NULL || response_msg == NULL || callback == NULL) {
    return service_refuse_argument();
  }
  handle = service_add(executor, service, request_msg, response_msg, RCLC_SERVICE_WITH_CONTEXT, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->callback.service_with_context = callback;
  handle->callback_context = context;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_service(rclc_executor_t * executor, const rcl_service_t * service)
{
  const rcl_ret_t result = rclc_executor_remove_handle(executor, service);

  if (result == RCL_RET_OK) {
    --executor->info.number_of_services;
  }
  return result;
}
