/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_graph_server.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_service.h"
#include "microros/text.h"

#include <string.h>

enum { GRAPH_ATTEMPTS = 2 };

char rcl_graph_texts[MICROROS_GRAPH_TEXTS][MICROROS_GRAPH_NAME_SIZE];

/* Takes a response that has arrived, of request `first` or a later one; an earlier query, which has expired, may have left its
 * own. RCL_RET_CLIENT_TAKE_FAILED: none waits. */
static rcl_ret_t graph_take(
  const rcl_client_t * client, int64_t first, void * response, rcl_graph_bind_t bind)
{
  rmw_request_id_t header;
  rcl_ret_t result;

  if (!rcl_client_is_valid(client)) {
    return microros_error_named(RCL_RET_ERROR, microros_error_graph_closed, NULL);
  }
  if (!rmw_requester_is_ready(client->impl)) {
    return RCL_RET_CLIENT_TAKE_FAILED;
  }
  if (bind != NULL) {
    bind(response);
  }
  result = rcl_take_response(client, &header, response);
  return result == RCL_RET_OK && header.sequence_number < first ? RCL_RET_CLIENT_TAKE_FAILED : result;
}

/* Waits for the response. RCL_RET_TIMEOUT without a text: none has arrived in half of the time, or before the limit. */
static rcl_ret_t graph_await(
  const rcl_client_t * client, int64_t first, void * response, rcl_graph_bind_t bind,
  const rcl_waiting_t * limit)
{
  rcl_waiting_t waiting =
    rcl_graph_waiting((uint32_t)MICROROS_CREATE_TIMEOUT_MS / (uint32_t)GRAPH_ATTEMPTS, limit);

  for (;;) {
    rcl_ret_t result;

    rcl_waiting_receive();
    microros_lock(); /* otherwise another task may close the node between two steps */
    result = graph_take(client, first, response, bind);
    microros_unlock();
    if (result != RCL_RET_CLIENT_TAKE_FAILED) {
      return result;
    }
    if (rcl_waiting_is_over(&waiting)) {
      return RCL_RET_TIMEOUT;
    }
    rcl_waiting_rest(&waiting, INT64_MAX);
  }
}

rcl_ret_t rcl_graph_ask(
  const rcl_client_t * client, const void * request, void * response, rcl_graph_bind_t bind,
  const rcl_waiting_t * limit)
{
  rcl_ret_t result = RCL_RET_TIMEOUT;
  int64_t first = INT64_MAX;

  /* A request that is sent before the server is discovered, or while a session is lost, has no response. */
  for (uint32_t attempt = 0; attempt < (uint32_t)GRAPH_ATTEMPTS && result != RCL_RET_OK; ++attempt) {
    const rcl_client_t now = rcl_graph_source_client(client);
    int64_t sequence_number;

    if (limit != NULL && rcl_waiting_is_over(limit)) {
      break;
    }
    result = rcl_send_request(&now, request, &sequence_number);
    if (result != RCL_RET_OK) {
      return result;
    }
    first = sequence_number < first ? sequence_number : first;
    result = graph_await(client, first, response, bind, limit);
  }
  if (result == RCL_RET_TIMEOUT) {
    microros_error_set(microros_error_graph_silent, NULL, NULL, rcl_graph_waited_ms(limit), 0);
  }
  return result;
}

rcl_ret_t rcl_graph_status(uint8_t status, const char * kind, const char * name)
{
  if (status == (uint8_t)microros_graph_msgs__srv__ListNames_Response__OK) {
    return RCL_RET_OK;
  }
  if (status == (uint8_t)microros_graph_msgs__srv__ListNames_Response__UNKNOWN_NODE) {
    microros_error_set(microros_error_graph_node, name, kind, 0, 0);
    return RCL_RET_NODE_NAME_NON_EXISTENT;
  }
  if (status == (uint8_t)microros_graph_msgs__srv__ListNames_Response__INVALID) {
    microros_error_set(microros_error_name, name, MICROROS_ERROR_WORDS("the graph server refuses it"), 0, 0);
    return RCL_RET_INVALID_ARGUMENT;
  }
  return microros_error_named(RCL_RET_ERROR, microros_error_graph, "a response with an unknown status");
}

void rcl_graph_lend(rosidl_runtime_c__String * string, char * text)
{
  string->data = text;
  string->size = text != NULL ? microros_text_size(text) : 0u;
  string->capacity = text != NULL ? string->size + 1u : 0u;
}

void rcl_graph_bind_text(rosidl_runtime_c__String * string, size_t index)
{
  string->data = rcl_graph_texts[index];
  string->size = 0;
  string->capacity = MICROROS_GRAPH_NAME_SIZE;
}
