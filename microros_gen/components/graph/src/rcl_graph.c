/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_graph.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_waiting.h"
#include "microros/rmw_service.h"
#include "microros/text.h"

#include <string.h>

enum { GRAPH_NS_PER_MS = 1000000, GRAPH_ATTEMPTS = 2 };

char rcl_graph_texts[MICROROS_GRAPH_TEXTS][MICROROS_GRAPH_NAME_SIZE];

static bool graph_is_busy;

bool rcl_graph_node_is_valid(const rcl_node_t * node)
{
  const bool is_valid = rcl_node_is_valid(node);

  if (!is_valid) {
    (void)microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  return is_valid;
}

rcl_ret_t rcl_graph_begin(void)
{
  bool is_free;

  if (!rcl_client_is_valid(&rcl_graph_names_client)) {
    return microros_error_named(RCL_RET_ERROR, microros_error_graph_closed, NULL);
  }
  microros_lock();
  is_free = !graph_is_busy;
  graph_is_busy = true;
  microros_unlock();
  return is_free ? RCL_RET_OK
                 : microros_error_named(RCL_RET_ERROR, microros_error_graph, "another query is being made");
}

void rcl_graph_end(void)
{
  graph_is_busy = false;
}

/* Waits for a response. RCL_RET_TIMEOUT without a text: none has arrived in half of the time. */
static rcl_ret_t graph_await(const rcl_client_t * client, void * response, rcl_graph_bind_t bind)
{
  const int64_t timeout_ms = (int64_t)MICROROS_CREATE_TIMEOUT_MS / GRAPH_ATTEMPTS;
  const rcl_waiting_t waiting = rcl_waiting_begin(timeout_ms * GRAPH_NS_PER_MS);

  for (;;) {
    rcl_waiting_receive();
    if (!rcl_client_is_valid(client)) {
      return microros_error_named(RCL_RET_ERROR, microros_error_graph_closed, NULL);
    }
    if (rmw_requester_is_ready(client->impl)) {
      rmw_request_id_t header;
      rcl_ret_t result;

      if (bind != NULL) {
        bind(response);
      }
      result = rcl_take_response(client, &header, response);
      if (result != RCL_RET_CLIENT_TAKE_FAILED) {
        return result;
      }
    }
    if (rcl_waiting_is_over(&waiting)) {
      return RCL_RET_TIMEOUT;
    }
    rcl_waiting_rest(&waiting, INT64_MAX);
  }
}

rcl_ret_t rcl_graph_ask(
  const rcl_client_t * client, const void * request, void * response, rcl_graph_bind_t bind)
{
  rcl_ret_t result = RCL_RET_TIMEOUT;

  /* A request that is sent before the server is discovered, or while a session is lost, has no response. */
  for (uint32_t attempt = 0; attempt < (uint32_t)GRAPH_ATTEMPTS && result != RCL_RET_OK; ++attempt) {
    int64_t sequence_number;

    result = rcl_send_request(client, request, &sequence_number);
    if (result != RCL_RET_OK) {
      return result;
    }
    result = graph_await(client, response, bind);
  }
  if (result == RCL_RET_TIMEOUT) {
    microros_error_set(microros_error_graph_silent, NULL, NULL, MICROROS_CREATE_TIMEOUT_MS, 0);
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

rcl_ret_t rcl_graph_write_name(const rmw_name_t * name, char full[MICROROS_GRAPH_NAME_SIZE])
{
  if (rmw_name_size(name) >= MICROROS_GRAPH_NAME_SIZE) {
    microros_error_set(
      microros_error_graph_limits, NULL, NULL, MICROROS_GRAPH_NAME_SIZE - 1u, MICROROS_GRAPH_TYPES_MAX);
    return RCL_RET_ERROR;
  }
  rmw_name_copy(name, full);
  return RCL_RET_OK;
}

char * rcl_graph_copy(const char * text, size_t size, const rcutils_allocator_t * allocator)
{
  char * copy = allocator->allocate(size + 1u, allocator->state);

  if (copy != NULL) {
    (void)memcpy(copy, text, size);
    copy[size] = '\0';
  }
  return copy;
}

rcl_ret_t rcl_graph_split(
  const rosidl_runtime_c__String * full, const rcutils_allocator_t * allocator, char ** name,
  char ** namespace_)
{
  size_t slash = full->size;

  while (slash != 0u && full->data[slash - 1u] != '/') {
    --slash;
  }
  if (slash == 0u) {
    return microros_error_named(RCL_RET_ERROR, microros_error_graph, "a node without a namespace");
  }
  *name = rcl_graph_copy(&full->data[slash], full->size - slash, allocator);
  if (*name == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  /* The slash is the namespace of a node of the root, and ends all others. */
  *namespace_ = rcl_graph_copy(full->data, slash > 1u ? slash - 1u : 1u, allocator);
  return *namespace_ != NULL ? RCL_RET_OK : RCL_RET_BAD_ALLOC;
}
