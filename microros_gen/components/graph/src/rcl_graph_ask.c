/* SPDX-License-Identifier: Apache-2.0 */
/* Asks the graph server, and reads lists of it page by page. */
#include "microros/rcl_graph_server.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_service.h"
#include "microros/text.h"
#include "rcl/error_handling.h"

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

enum { PAGES_ATTEMPTS = 5 }; /* of a list that changes while it is read */

rcl_ret_t rcl_graph_source_refuse_long(void)
{
  microros_error_set(
    microros_error_graph_limits, NULL, NULL, 2u * (MICROROS_GRAPH_NAME_SIZE - 1u),
    2u * MICROROS_GRAPH_TYPES_MAX);
  return RCL_RET_ERROR;
}

/* Refuses a page that is no continuation from item `first` on, or not all of it. */
static rcl_ret_t pages_check(const rcl_graph_page_t * page, uint32_t first)
{
  if (page->truncated) {
    return rcl_graph_source_refuse_long();
  }
  if (
    page->next > page->total || page->next < first || page->next - first != page->size ||
    (page->size == 0u && first != page->total)) {
    return microros_error_named(RCL_RET_ERROR, microros_error_graph, "a response that contradicts itself");
  }
  return RCL_RET_OK;
}

static rcl_ret_t pages_put(
  const rcl_graph_reader_t * reader, void * list, uint32_t first, const rcl_graph_page_t * page)
{
  rcl_ret_t result = RCL_RET_OK;

  for (size_t i = 0; i < page->size && result == RCL_RET_OK; ++i) {
    result = reader->put(list, i, (size_t)first + i);
  }
  return result;
}

/* Reads the pages after the first one. *changed: the graph has changed since that, or its server is silent. */
static rcl_ret_t pages_continue(
  const rcl_graph_reader_t * reader, void * list, const rcl_graph_page_t * begun, bool * changed)
{
  uint32_t first = begun->next;

  while (first != begun->total) {
    rcl_graph_page_t page;
    rcl_ret_t result;

    page.version = begun->version;
    result = reader->ask(list, first, &page);
    if (result == RCL_RET_TIMEOUT) { /* its server may be gone, and another one be there */
      rcl_reset_error();
      *changed = true;
      return RCL_RET_OK;
    }
    if (result != RCL_RET_OK) {
      return result;
    }
    *changed = page.version != begun->version || page.total != begun->total;
    if (*changed) {
      return RCL_RET_OK;
    }
    result = pages_check(&page, first);
    if (result == RCL_RET_OK) {
      result = pages_put(reader, list, first, &page);
    }
    if (result != RCL_RET_OK) {
      return result;
    }
    first = page.next;
  }
  return RCL_RET_OK;
}

/* Reads all pages once. */
static rcl_ret_t pages_attempt(const rcl_graph_reader_t * reader, void * list, bool * changed)
{
  rcl_graph_page_t page;
  rcl_ret_t result;

  page.version = 0;
  result = reader->ask(list, 0, &page);
  *changed = false;
  if (result == RCL_RET_OK) {
    result = pages_check(&page, 0);
  }
  if (result == RCL_RET_OK) {
    result = reader->make(list, (size_t)page.total);
  }
  if (result != RCL_RET_OK) {
    return result;
  }
  result = pages_put(reader, list, 0, &page);
  if (result == RCL_RET_OK) {
    result = pages_continue(reader, list, &page, changed);
  }
  if (result != RCL_RET_OK || *changed) {
    reader->drop(list);
  }
  return result;
}

rcl_ret_t rcl_graph_read(const rcl_graph_reader_t * reader, void * list)
{
  rcl_ret_t result = rcl_graph_begin();
  bool changed = true;

  if (result != RCL_RET_OK) {
    return result;
  }
  for (uint32_t i = 0; i < (uint32_t)PAGES_ATTEMPTS && changed && result == RCL_RET_OK; ++i) {
    result = pages_attempt(reader, list, &changed);
  }
  rcl_graph_end();
  result = rcl_graph_result(result);
  if (result == RCL_RET_OK && changed) {
    result = microros_error_named(RCL_RET_ERROR, microros_error_graph, "it changes faster than it is read");
  }
  return result;
}
