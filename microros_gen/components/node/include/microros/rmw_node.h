/* SPDX-License-Identifier: Apache-2.0 */
/* Nodes of the middleware layer: opens and closes places. Internal. */
#ifndef MICROROS_RMW_NODE_H
#define MICROROS_RMW_NODE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_entities.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RMW_NO_PLACE 0xffffu

/*
 * Takes a place for a node and waits for its participant. RMW_RET_OK: *node is set and belongs to the
 * library; otherwise RMW_RET_TIMEOUT or RMW_RET_ERROR with a text. `name` and `namespace_` are valid.
 */
rmw_ret_t rmw_node_open(
  rmw_context_t * context, const char * name, const char * namespace_, rmw_node_t ** node);

/* Releases the place and those of its publishers. */
void rmw_node_close(rmw_node_t * node);

bool rmw_node_is_open(const rmw_node_t * node);

/* Returns the node's index in the client's table. */
uint16_t rmw_node_index(const rmw_node_t * node);

/* Returns a free place for the node with its names and domain filled in, or RMW_NO_PLACE with a text.
 * Declared nodes and pools implement it differently. */
uint16_t rmw_node_take(xrce_client_t * client, const char * name, const char * namespace_);

/* Opens a filled-in place and waits for the agent; on failure closes it again and sets the text. */
rmw_ret_t rmw_place_open(xrce_client_t * client, uint16_t place, const char * name);

/* Closes the place and waits as long as the application allows; later calls finish the rest. */
void rmw_place_close(xrce_client_t * client, uint16_t place);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_NODE_H */
