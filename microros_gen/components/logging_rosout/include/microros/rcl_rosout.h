/* SPDX-License-Identifier: Apache-2.0 */
/* The publisher of /rosout, which the library opens with a node. Internal. */
#ifndef MICROROS_RCL_ROSOUT_H
#define MICROROS_RCL_ROSOUT_H

#include <stdbool.h>
#include <stdint.h>

#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new node: the first node of the application file gets the publisher.
 * Waits for the agent and returns the same codes as rcl_publisher_init. */
rcl_ret_t rcl_rosout_open(const rcl_node_t * node);

/* Called before a node is closed. If it has the publisher, lines wait until a node is opened again. */
void rcl_rosout_close(const rcl_node_t * node);

/* Returns whether the node, by its index in the client's table, was closed since the last call. */
bool rcl_rosout_was_closed(uint16_t node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ROSOUT_H */
