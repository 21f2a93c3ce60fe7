/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph_server.h"
#include "rcl/error_handling.h"

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
