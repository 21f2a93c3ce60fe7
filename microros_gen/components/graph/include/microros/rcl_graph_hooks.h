/* SPDX-License-Identifier: Apache-2.0 */
/* The library's own endpoints for the graph, opened with a node. Internal. */
#ifndef MICROROS_RCL_GRAPH_HOOKS_H
#define MICROROS_RCL_GRAPH_HOOKS_H

#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new node: the first one of the application file gets the endpoints. Waits for the agent and
 * returns the codes of rcl_client_init. */
rcl_ret_t rcl_graph_open(rcl_node_t * node);

/* Called before a node is closed. */
void rcl_graph_close(rcl_node_t * node);

/* Called after receiving: triggers the guard conditions of all nodes if the graph has changed. */
void rcl_graph_follow(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_HOOKS_H */
