/* SPDX-License-Identifier: Apache-2.0 */
/* Endpoints of nodes; internal. */
#ifndef MICROROS_RMW_NODE_ENDPOINTS_H
#define MICROROS_RMW_NODE_ENDPOINTS_H

#include <stdbool.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether `endpoint`, the data of a handle of rmw, is one of this open node. */
bool rmw_node_has_endpoint(const rmw_node_t * node, const void * endpoint);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_NODE_ENDPOINTS_H */
