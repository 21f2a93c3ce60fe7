/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by rclc and rcl: a node without options. Internal; pointers are already checked. */
#ifndef MICROROS_RCL_NODE_OPEN_H
#define MICROROS_RCL_NODE_OPEN_H

#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

rcl_ret_t rcl_node_open(
  rcl_node_t * node, const char * name, const char * namespace_, rcl_context_t * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NODE_OPEN_H */
