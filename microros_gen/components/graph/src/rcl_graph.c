/* SPDX-License-Identifier: Apache-2.0 */
/* The source of the graph belongs to the first node; guard conditions are triggered by its changes. Whichever task
 * receives follows them, in the lock. */
#include "microros/rcl_graph.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_graph_hooks.h"
#include "microros/rcl_guard_condition.h"
#include "microros/rmw_node.h"
#include "rcl/error_handling.h"

#include <string.h>

enum { GRAPH_NS_PER_MS = 1000000 };

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

  if (!rcl_graph_source_is_open()) {
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
  microros_lock();
  graph_is_busy = false;
  microros_unlock();
}

rcl_ret_t rcl_graph_write_name(const rmw_name_t * name, char full[MICROROS_GRAPH_NAME_SIZE])
{
  if (rmw_name_size(name) >= MICROROS_GRAPH_NAME_SIZE) {
    return rcl_graph_source_refuse_long();
  }
  rmw_name_copy(name, full);
  return RCL_RET_OK;
}

rcl_waiting_t rcl_graph_waiting(uint32_t most_ms, const rcl_waiting_t * limit)
{
  rcl_waiting_t waiting = rcl_waiting_begin((int64_t)most_ms * GRAPH_NS_PER_MS);

  if (limit != NULL && limit->timeout_ms != UINT32_MAX) {
    const uint32_t passed_ms = waiting.start_ms - limit->start_ms;
    const uint32_t left_ms = passed_ms < limit->timeout_ms ? limit->timeout_ms - passed_ms : 0u;

    waiting.timeout_ms = left_ms < most_ms ? left_ms : most_ms;
  }
  return waiting;
}

uint32_t rcl_graph_waited_ms(const rcl_waiting_t * limit)
{
  const bool is_shorter = limit != NULL && limit->timeout_ms < (uint32_t)MICROROS_CREATE_TIMEOUT_MS;

  return is_shorter ? limit->timeout_ms : (uint32_t)MICROROS_CREATE_TIMEOUT_MS;
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
  const char * full, size_t size, const rcutils_allocator_t * allocator, char ** name, char ** namespace_)
{
  size_t slash = size;

  while (slash != 0u && full[slash - 1u] != '/') {
    --slash;
  }
  if (slash == 0u) {
    return microros_error_named(RCL_RET_ERROR, microros_error_graph, "a node without a namespace");
  }
  *name = rcl_graph_copy(&full[slash], size - slash, allocator);
  if (*name == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  /* The slash is the namespace of a node of the root, and ends all others. */
  *namespace_ = rcl_graph_copy(full, slash > 1u ? slash - 1u : 1u, allocator);
  return *namespace_ != NULL ? RCL_RET_OK : RCL_RET_BAD_ALLOC;
}

rcl_ret_t rcl_graph_result(rcl_ret_t result)
{
  if (result == RCL_RET_BAD_ALLOC && !rcutils_error_is_set()) { /* the default allocator names the key */
    return microros_error_named(result, microros_error_graph, "the allocator gives no memory");
  }
  return result;
}

static const rmw_node_t * graph_node; /* the owner of the endpoints */
static uint32_t graph_changes;

/* Indexed by node; taken while the node is open. */
static rcl_guard_condition_t graph_conditions[MICROROS_NODES_MAX];
static struct rcl_guard_condition_impl_s graph_triggers[MICROROS_NODES_MAX];

rcl_ret_t rcl_graph_open(rcl_node_t * node)
{
  const uint16_t index = rmw_node_index(node->impl);

  microros_lock(); /* another task may announce a change now */
  graph_triggers[index].taken = true;
  microros_flag_clear(&graph_triggers[index].is_triggered);
  graph_conditions[index].impl = &graph_triggers[index];
  graph_conditions[index].context = node->context;
  microros_unlock();
  if (index != 0u) {
    return RCL_RET_OK;
  }
  graph_node = node->impl; /* declared with the first node */
  return rcl_graph_source_open(node);
}

void rcl_graph_close(rcl_node_t * node)
{
  microros_lock();
  graph_triggers[rmw_node_index(node->impl)].taken = false;
  microros_unlock();
  if (graph_node != node->impl) {
    return;
  }
  rcl_graph_source_close(node);
  graph_node = NULL;
}

static void graph_announce(void)
{
  ++graph_changes;
  for (size_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    if (graph_triggers[i].taken) {
      (void)rcl_trigger_guard_condition(&graph_conditions[i]); /* cannot fail: it is valid */
    }
  }
}

void rcl_graph_follow(void)
{
  microros_lock();
  if (rcl_graph_source_has_changed()) {
    graph_announce();
  }
  microros_unlock();
}

uint32_t rcl_graph_changes(void)
{
  uint32_t changes;

  microros_lock();
  changes = graph_changes;
  microros_unlock();
  return changes;
}

const rcl_guard_condition_t * rcl_node_get_graph_guard_condition(const rcl_node_t * node)
{
  if (!rcl_graph_node_is_valid(node)) {
    return NULL;
  }
  return &graph_conditions[rmw_node_index(node->impl)];
}
