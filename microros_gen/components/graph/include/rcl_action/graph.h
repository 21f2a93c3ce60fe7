/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Queries of the ROS graph for actions. They are queries of rcl/graph.h for topics, with the same waiting time, memory and
 * codes. While a query runs, the allocator holds all topics of the node, or of the graph; those that belong to no action are
 * freed before it returns.
 */
#ifndef MICROROS_RCL_ACTION_GRAPH_H
#define MICROROS_RCL_ACTION_GRAPH_H

#include "rcl/graph.h"
#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Actions with a client of a node, with their types ("example_interfaces/action/Fibonacci"). */
rcl_ret_t rcl_action_get_client_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * node_name, const char * node_namespace,
  rcl_names_and_types_t * action_names_and_types);

/* Actions with a server of a node. */
rcl_ret_t rcl_action_get_server_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * node_name, const char * node_namespace,
  rcl_names_and_types_t * action_names_and_types);

/* All actions. */
rcl_ret_t rcl_action_get_names_and_types(
  const rcl_node_t * node, rcl_allocator_t * allocator, rcl_names_and_types_t * action_names_and_types);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_GRAPH_H */
