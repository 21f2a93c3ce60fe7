/* SPDX-License-Identifier: Apache-2.0 */
/* What the graph knows of an action's server; with the component `graph`. */
#ifndef MICROROS_RCL_ACTION_AVAILABLE_H
#define MICROROS_RCL_ACTION_AVAILABLE_H

#include <stdbool.h>

#include "rcl/node.h"
#include "rcl_action/action_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sets *is_available to whether the action has the three services and the feedback of a server. Each is a query of the
 * graph; codes of a query that fails are returned. RCL_RET_NODE_INVALID, RCL_RET_ACTION_CLIENT_INVALID, and
 * RCL_RET_INVALID_ARGUMENT for NULL.
 */
rcl_ret_t rcl_action_server_is_available(
  const rcl_node_t * node, const rcl_action_client_t * client, bool * is_available);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_AVAILABLE_H */
