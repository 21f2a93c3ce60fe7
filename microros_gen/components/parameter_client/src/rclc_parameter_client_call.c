/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/port.h"
#include "microros/rcl_waiting.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rmw_service.h"

enum { PARAMETER_CALL_NS_PER_MS = 1000000, CLIENT_REPORTS = 3 };

static rmw_client_t * parameter_call_handle(const rclc_parameter_client_t * client)
{
  return client->services[client->call].impl;
}

/* Discards late responses and loss reports of earlier calls. */
static void parameter_call_drain(rclc_parameter_client_t * client)
{
  const uint32_t most = (uint32_t)MICROROS_REQUESTS_MAX + (uint32_t)CLIENT_REPORTS;

  for (uint32_t i = 0; i < most && rmw_requester_is_ready(parameter_call_handle(client)); ++i) {
    rmw_service_info_t info;
    bool taken;

    (void)rmw_requester_take(parameter_call_handle(client), &info, client, &taken);
  }
}

static rcl_ret_t parameter_call_check(
  const rclc_parameter_client_t * client, uint8_t call, uint32_t timeout_ms)
{
  if (timeout_ms == 0u || timeout_ms > (uint32_t)INT32_MAX) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "timeout_ms");
  }
  if (!rcl_client_is_valid(&client->services[call])) {
    return rclc_parameter_client_refuse(
      client, RCL_RET_ERROR, MICROROS_ERROR_WORDS("not open, or the operation is not declared"));
  }
  if (client->in_event) {
    return rclc_parameter_client_refuse(
      client, RCLC_PARAMETER_CLIENT_IN_CALLBACK, MICROROS_ERROR_WORDS("called in the callback of an event"));
  }
  if (client->is_busy) {
    return rclc_parameter_client_refuse(
      client, RCLC_PARAMETER_CLIENT_BUSY, MICROROS_ERROR_WORDS("the last call has no result yet"));
  }
  return RCL_RET_OK;
}

/* Sends the request; the call is busy then. */
static rcl_ret_t parameter_call_begin(
  rclc_parameter_client_t * client, uint8_t call, const void * items, size_t count, uint32_t timeout_ms)
{
  rcl_ret_t result;

  client->call = call;
  parameter_call_drain(client);
  client->items = items;
  client->count = count;
  client->requested = count;
  client->timeout_ms = timeout_ms;
  result = rcl_send_request(&client->services[call], client, &client->sequence);
  client->start_ms = port_time_ms();
  client->is_busy = result == RCL_RET_OK;
  client->items = NULL;
  client->count = 0;
  client->size = 0;
  return result;
}

rcl_ret_t rclc_parameter_client_send(
  rclc_parameter_client_t * client, uint8_t call, const void * items, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context)
{
  rcl_ret_t result = parameter_call_check(client, call, timeout_ms);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (callback == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "callback");
  }
  if (client->executor == NULL) {
    return rclc_parameter_client_refuse(
      client, RCL_RET_ERROR,
      MICROROS_ERROR_WORDS("no executor runs the client: call rclc_executor_add_parameter_client"));
  }
  result = parameter_call_begin(client, call, items, count, timeout_ms);
  client->callback = callback;
  client->context = context;
  return result;
}

rcl_ret_t rclc_parameter_client_send_and_wait(
  rclc_parameter_client_t * client, uint8_t call, const void * items, size_t count, uint32_t timeout_ms)
{
  rcl_waiting_t waiting;
  rcl_ret_t result = parameter_call_check(client, call, timeout_ms);

  if (result == RCL_RET_OK && client->is_calling) {
    result = rclc_parameter_client_refuse(
      client, RCLC_PARAMETER_CLIENT_IN_CALLBACK,
      MICROROS_ERROR_WORDS("a callback of its executor must not wait: make the call with _async"));
  }
  if (result == RCL_RET_OK) {
    result = parameter_call_begin(client, call, items, count, timeout_ms);
  }
  if (result != RCL_RET_OK) {
    return result;
  }
  waiting = rcl_waiting_begin((int64_t)timeout_ms * PARAMETER_CALL_NS_PER_MS);
  for (;;) {
    rcl_waiting_receive();
    if (rclc_parameter_client_is_due(client) && rclc_parameter_client_is_done(client, &result)) {
      return result;
    }
    rcl_waiting_rest(&waiting, INT64_MAX);
  }
}

uint32_t rclc_parameter_client_left_ms(const rclc_parameter_client_t * client)
{
  const uint32_t passed_ms = port_time_ms() - client->start_ms;

  return passed_ms < client->timeout_ms ? client->timeout_ms - passed_ms : 0u;
}

bool rclc_parameter_client_is_due(const rclc_parameter_client_t * client)
{
  return client->is_busy && (!rcl_client_is_valid(&client->services[client->call]) ||
                             rmw_requester_is_ready(parameter_call_handle(client)) ||
                             rclc_parameter_client_left_ms(client) == 0u);
}

/* Returns the result of the kept response. */
static rcl_ret_t parameter_call_judge(rclc_parameter_client_t * client)
{
#if MICROROS_PARAMETER_CLIENT_SETS || MICROROS_PARAMETER_CLIENT_SETS_ATOMICALLY
  if (
    client->call == (uint8_t)RCLC_PARAMETER_CLIENT_SET ||
    client->call == (uint8_t)RCLC_PARAMETER_CLIENT_SET_ATOMICALLY) {
    return rclc_parameter_client_judge_results(client);
  }
#endif
#if MICROROS_PARAMETER_CLIENT_GETS || MICROROS_PARAMETER_CLIENT_DESCRIBES || \
  MICROROS_PARAMETER_CLIENT_GETS_TYPES
  if (client->call != (uint8_t)RCLC_PARAMETER_CLIENT_LIST) {
    return rclc_parameter_client_judge_names(client);
  }
#endif
  return RCL_RET_OK;
}

/* Takes the response, if it has arrived. A response that does not fit ends the call. */
static rcl_ret_t parameter_call_take(
  rclc_parameter_client_t * client, rmw_service_info_t * info, bool * taken)
{
  uint16_t fits = 0;
  const uint16_t large = rclc_parameter_client_take_large(client, &fits);
  rcl_ret_t result;

  if (large != 0u) {
    microros_error_set(microros_error_parameter_client_large, client->remote->name, NULL, large, fits);
    return RCLC_PARAMETER_CLIENT_LIMIT;
  }
  client->exceeds = 0;
  result = rmw_requester_take(parameter_call_handle(client), info, client, taken);
  return result != RCL_RET_OK && client->exceeds != 0u
           ? rclc_parameter_client_refuse_limit(
               client, MICROROS_ERROR_WORDS("elements"), client->exceeds, MICROROS_PARAMETER_CLIENT_ELEMENTS)
           : result;
}

/* Ends the call. */
static bool parameter_call_end(rclc_parameter_client_t * client)
{
  client->is_busy = false;
  if (client->size == 0u) {
    client->call = (uint8_t)RCLC_PARAMETER_CLIENT_CALLS;
  }
  return true;
}

bool rclc_parameter_client_is_done(rclc_parameter_client_t * client, rcl_ret_t * result)
{
  rmw_service_info_t info = {.request_id = {.sequence_number = 0}};
  bool taken = false;

  if (!rcl_client_is_valid(&client->services[client->call])) {
    *result = microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
    return parameter_call_end(client);
  }
  client->size = 0;
  *result = parameter_call_take(client, &info, &taken);
  if (taken && info.request_id.sequence_number == client->sequence) {
    *result = parameter_call_judge(client);
    return parameter_call_end(client);
  }
  client->size = 0;
  if (
    *result != RCL_RET_OK &&
    (info.request_id.sequence_number == 0 || info.request_id.sequence_number == client->sequence)) {
    return parameter_call_end(client); /* otherwise it is the late response of an earlier call */
  }
  if (rclc_parameter_client_left_ms(client) == 0u) {
    microros_error_set(
      microros_error_parameter_client_silent, client->remote->name, NULL, client->timeout_ms, 0);
    *result = RCL_RET_TIMEOUT;
    return parameter_call_end(client);
  }
  return false;
}
