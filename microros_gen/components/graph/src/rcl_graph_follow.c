/* SPDX-License-Identifier: Apache-2.0 */
/* The source of the graph belongs to the first node; guard conditions are triggered by its changes. Whichever task
 * receives follows them, in the lock. */
#include "microros/lock.h"
#include "microros/rcl_graph.h"
#include "microros/rcl_graph_hooks.h"
#include "microros/rcl_guard_condition.h"
#include "microros/rmw_node.h"

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
