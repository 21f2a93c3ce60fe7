/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_graph.h"
#include "microros/rcl_graph_scan.h"
#include "microros/rmw_graph_reader.h"

enum { GROW_STEP = 8 };

bool rcl_graph_grow(void ** array, size_t count, size_t size, const rcutils_allocator_t * allocator)
{
  void * larger;

  if (count % (size_t)GROW_STEP != 0u) {
    return true;
  }
  larger = allocator->reallocate(*array, (count + (size_t)GROW_STEP) * size, allocator->state);
  if (larger != NULL) {
    *array = larger;
  }
  return larger != NULL;
}

void rcl_graph_clear(rcutils_string_array_t * array, const rcutils_allocator_t * allocator)
{
  if (array->data != NULL) {
    (void)rcutils_string_array_fini(array); /* cannot fail: the allocator is valid */
  }
  *array = rcutils_get_zero_initialized_string_array();
  array->allocator = *allocator;
}

bool rcl_graph_add_text(rcutils_string_array_t * array, const char * text, size_t size)
{
  void * data = array->data;

  if (!rcl_graph_grow(&data, array->size, sizeof(char *), &array->allocator)) {
    return false;
  }
  array->data = data;
  array->data[array->size] = rcl_graph_copy(text, size, &array->allocator);
  if (array->data[array->size] == NULL) {
    return false;
  }
  ++array->size;
  return true;
}

/* The query that is answered from the sample that arrives; changed in the lock alone. */
static const rcl_graph_scanner_t * scan_scanner; /* NULL: no query, or it has ended */
static void * scan_list;
static rcl_ret_t scan_result;
static uint32_t scan_fragments; /* that have arrived */
static bool scan_changed;       /* and it differed from the one before */

static void scan_end(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    scan_scanner->drop(scan_list);
  }
  scan_result = result;
  scan_scanner = NULL;
}

static void scan_part(const rcl_graph_cdr_t * cdr, rcl_graph_part_t part)
{
  if (scan_scanner != NULL) {
    const rcl_ret_t result = scan_scanner->scan(scan_list, cdr, part);

    if (result != RCL_RET_OK) {
      scan_end(result);
    }
  }
}

static void sink_begin(void * state, bool big_endian)
{
  rcl_graph_cdr_begin(state, big_endian);
  ++scan_fragments;
  if (scan_scanner != NULL) {
    scan_scanner->drop(scan_list); /* of a sample that was broken off */
  }
}

static void sink_take(void * state, const uint8_t * bytes, size_t size)
{
  ++scan_fragments;
  rcl_graph_cdr_take(state, bytes, size, scan_part);
}

static void sink_end(void * state, bool complete)
{
  static uint32_t hash; /* of the last whole sample */
  const rcl_graph_cdr_t * cdr = state;

  if (!complete || !rcl_graph_cdr_is_complete(cdr)) {
    return; /* the query waits for the next one */
  }
  scan_changed = scan_changed || cdr->hash != hash;
  hash = cdr->hash;
  if (scan_scanner != NULL) {
    scan_end(RCL_RET_OK);
  }
}

rcl_ret_t rcl_graph_source_open(rcl_node_t * node)
{
  static rcl_graph_cdr_t graph_part;
  static const xrce_sink_t sink = {sink_begin, sink_take, sink_end, &graph_part};

  return rmw_graph_reader_open(node->impl, &sink);
}

void rcl_graph_source_close(rcl_node_t * node)
{
  (void)node;
  rmw_graph_reader_close();
}

bool rcl_graph_source_is_open(void)
{
  return rmw_graph_reader_is_open();
}

bool rcl_graph_source_has_changed(void)
{
  bool changed;

  microros_lock();
  changed = scan_changed;
  scan_changed = false;
  microros_unlock();
  return changed;
}

/* Returns whether the query goes on, and how many fragments have arrived. */
static bool scan_continues(uint32_t * fragments)
{
  bool continues;

  microros_lock();
  continues = scan_scanner != NULL;
  *fragments = scan_fragments;
  microros_unlock();
  return continues;
}

/* Ends a query that has got no whole sample. */
static void scan_time_out(void)
{
  microros_lock();
  if (scan_scanner != NULL) {
    scan_end(RCL_RET_TIMEOUT);
  }
  microros_unlock();
}

static void scan_await(const rcl_waiting_t * limit)
{
  rcl_waiting_t waiting = rcl_graph_waiting(MICROROS_CREATE_TIMEOUT_MS, limit);
  uint32_t before;
  uint32_t fragments;

  (void)scan_continues(&before);
  while (scan_continues(&fragments)) {
    if (fragments != before) {
      before = fragments;
      waiting = rcl_graph_waiting(MICROROS_CREATE_TIMEOUT_MS, limit);
    }
    if (rcl_waiting_is_over(&waiting)) {
      scan_time_out();
    } else {
      rcl_waiting_rest(&waiting, INT64_MAX);
      rcl_waiting_receive();
    }
  }
}

static void scan_begin(const rcl_graph_scanner_t * scanner, void * list)
{
  microros_lock();
  scanner->drop(list);
  scan_list = list;
  scan_scanner = scanner;
  rmw_graph_reader_renew();
  microros_unlock();
}

rcl_ret_t rcl_graph_source_refuse_long(void)
{
  microros_error_set(microros_error_graph_topic_limits, NULL, NULL, 2u * (MICROROS_GRAPH_NAME_SIZE - 1u), 0);
  return RCL_RET_ERROR;
}

static rcl_ret_t scan_report(rcl_ret_t result, const rcl_waiting_t * limit)
{
  if (result == RCL_RET_ERROR) {
    return rcl_graph_source_refuse_long();
  }
  if (result == RCL_RET_TIMEOUT) {
    microros_error_set(microros_error_graph_topic_silent, NULL, NULL, rcl_graph_waited_ms(limit), 0);
  }
  return rcl_graph_result(result);
}

rcl_ret_t rcl_graph_scan(const rcl_graph_scanner_t * scanner, void * list, const rcl_waiting_t * limit)
{
  rcl_ret_t result = rcl_graph_begin();

  if (result != RCL_RET_OK) {
    return result;
  }
  scan_begin(scanner, list);
  scan_await(limit);
  result = scan_result;
  rcl_graph_end();
  return scan_report(result, limit);
}
