/* SPDX-License-Identifier: Apache-2.0 */
/* The client of the graph server's service for events, opened with the first node. Internal. */
#ifndef MICROROS_RCL_GRAPH_EVENTS_HOOKS_H
#define MICROROS_RCL_GRAPH_EVENTS_HOOKS_H

#include <stdint.h>

#include "microros/xrce_client.h"
#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new node. Waits for the agent and returns the codes of rcl_client_init. */
rcl_ret_t rcl_graph_events_open(const rcl_node_t * node);

/* Called before a node is closed. */
void rcl_graph_events_close(rcl_node_t * node);

/* Called after receiving: takes a response and sends the next request. Does not wait. */
void rcl_graph_events_follow(void);

/* Returns the time until a request is sent once more, at most `left`. */
uint32_t rcl_graph_events_left(const xrce_client_t * client, uint32_t left, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_EVENTS_HOOKS_H */
