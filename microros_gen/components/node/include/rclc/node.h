/* SPDX-License-Identifier: Apache-2.0 */
/* Nodes with default options; codes and waiting as for rcl_node_init. */
#ifndef MICROROS_RCLC_NODE_H
#define MICROROS_RCLC_NODE_H

#include "rcl/node.h"
#include "rclc/init.h"
#include "rclc/types.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

rcl_ret_t rclc_node_init_default(
  rcl_node_t * node, const char * name, const char * namespace_, rclc_support_t * support);

rcl_ret_t rclc_node_init_with_options(
  rcl_node_t * node, const char * name, const char * namespace_, rclc_support_t * support,
  rcl_node_options_t * node_ops);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_NODE_H */
