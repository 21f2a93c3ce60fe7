/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Queries that are answered from a sample of ros_to_microros_graph while it arrives. The agent sends the
 * last sample once more for each query; only the requested part of it is stored. Internal. */
#ifndef MICROROS_RCL_GRAPH_SCAN_H
#define MICROROS_RCL_GRAPH_SCAN_H

#include <stddef.h>

#include "microros/rcl_graph_cdr.h"
#include "microros/rcl_waiting.h"
#include "rcl/types.h"
#include "rcutils/types/string_array.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A query; `list` is the caller's. Both functions are called while a session is pumped, by whichever task
 * does that. */
typedef struct rcl_graph_scanner_t {
  /* A part of the sample. RCL_RET_BAD_ALLOC, or RCL_RET_ERROR for a text that was truncated, ends the query. */
  rcl_ret_t (*scan)(void * list, const rcl_graph_cdr_t * cdr, rcl_graph_part_t part);
  /* Frees what was stored: a sample begins, or the query has failed. */
  void (*drop)(void * list);
} rcl_graph_scanner_t;

/*
 * Scans a whole sample. Waits at most MICROROS_CREATE_TIMEOUT_MS for each fragment. On an error a
 * text is set and the list was dropped. RCL_RET_TIMEOUT also when `limit` has expired; NULL: no limit. */
rcl_ret_t rcl_graph_scan(const rcl_graph_scanner_t * scanner, void * list, const rcl_waiting_t * limit);

/* Makes room for one more element in an array that has `count` of `size` bytes; false: no memory. */
bool rcl_graph_grow(void ** array, size_t count, size_t size, const rcutils_allocator_t * allocator);

/* Frees what an array has, and leaves it empty. */
void rcl_graph_clear(rcutils_string_array_t * array, const rcutils_allocator_t * allocator);

/* Appends a copy of a text to an array; false: no memory. */
bool rcl_graph_add_text(rcutils_string_array_t * array, const char * text, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_SCAN_H */
