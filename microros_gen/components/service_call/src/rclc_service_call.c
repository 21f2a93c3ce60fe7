/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/service_call.h"

#include "microros/error.h"
#include "microros/rcl_waiting.h"
#include "microros/rclc_service_call.h"
#include "microros/rmw_service.h"
#include "microros_config.h"

#include <stddef.h>

/* Reports that a requester may have besides responses: a lost session, a large one, a refused READ_DATA. */
enum { CALL_REPORTS = 3, CALL_NS_PER_MS = 1000000 };

static bool call_is_run(const rclc_executor_t * executor, const rcl_client_t * client)
{
  for (size_t i = 0; i < executor->index; ++i) {
    if (executor->handles[i].client == client) {
      return true;
    }
  }
  return false;
}

static rcl_ret_t call_check(
  const rclc_executor_t * executor, const rcl_client_t * client, const void * request, const void * response,
  uint64_t timeout_ns)
{
  const uint64_t longest_ns = (uint64_t)INT32_MAX * (uint64_t)CALL_NS_PER_MS;

  if (
    executor == NULL || client == NULL || request == NULL || response == NULL || timeout_ns == 0u ||
    timeout_ns > longest_ns) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "executor, client, request, response or timeout_ns");
  }
  if (!rcl_client_is_valid(client)) {
    return microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
  }
  if (rclc_service_call_is_in_round(executor)) {
    return microros_error_named(
      RCL_RET_ERROR, microros_error_executor, "a callback must not wait: call rcl_send_request");
  }
  if (call_is_run(executor, client)) {
    return microros_error_named(
      RCL_RET_ERROR, microros_error_executor, "its client cannot wait: use a client that was not added");
  }
  return RCL_RET_OK;
}

/* Discards late responses and reports of earlier calls. */
static void call_drain(const rmw_client_t * handle, void * response)
{
  const uint32_t most = (uint32_t)MICROROS_REQUESTS_MAX + (uint32_t)CALL_REPORTS;

  for (uint32_t i = 0; i < most && rmw_requester_is_ready(handle); ++i) {
    rmw_service_info_t info;
    bool taken;

    (void)rmw_requester_take(handle, &info, response, &taken);
  }
}

/* Takes what has arrived; returns whether the call is over, with its result. */
static bool call_take(const rmw_client_t * handle, int64_t sequence, void * response, rcl_ret_t * result)
{
  while (rmw_requester_is_ready(handle)) {
    rmw_service_info_t info = {.request_id = {.sequence_number = 0}};
    bool taken = false;

    *result = rmw_requester_take(handle, &info, response, &taken);
    if (
      info.request_id.sequence_number == sequence ||
      (info.request_id.sequence_number == 0 && *result != RCL_RET_OK)) {
      return true; /* otherwise it is the late response of an earlier call */
    }
  }
  return false;
}

static rcl_ret_t call_wait(
  const rcl_client_t * client, int64_t sequence, void * response, uint64_t timeout_ns)
{
  rcl_waiting_t waiting = rcl_waiting_begin((int64_t)timeout_ns);
  rcl_ret_t result = RCL_RET_ERROR;

  for (;;) {
    rcl_waiting_receive();
    if (!rcl_client_is_valid(client)) { /* another task ended the context */
      return microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
    }
    if (call_take(client->impl, sequence, response, &result)) {
      return result;
    }
    if (rcl_waiting_is_over(&waiting)) {
      microros_error_set(
        microros_error_service_call_silent, client->impl->service_name, NULL, waiting.timeout_ms, 0);
      return RCL_RET_TIMEOUT;
    }
    rcl_waiting_rest(&waiting, INT64_MAX);
  }
}

rcl_ret_t rclc_executor_call_service(
  rclc_executor_t * executor, rcl_client_t * client, const void * request, void * response,
  uint64_t timeout_ns)
{
  int64_t sequence = 0;
  rcl_ret_t result = call_check(executor, client, request, response, timeout_ns);

  if (result != RCL_RET_OK) {
    return result;
  }
  rmw_requester_bind(client->impl, response);
  call_drain(client->impl, response);
  result = rcl_send_request(client, request, &sequence);
  return result == RCL_RET_OK ? call_wait(client, sequence, response, timeout_ns) : result;
}
