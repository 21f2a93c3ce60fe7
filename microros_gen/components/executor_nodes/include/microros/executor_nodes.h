/* SPDX-License-Identifier: Apache-2.0 */
/* Which handles are those of a node; internal. */
#ifndef MICROROS_EXECUTOR_NODES_INTERNAL_H
#define MICROROS_EXECUTOR_NODES_INTERNAL_H

#include <stdbool.h>

#include "rcl/node.h"
#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the handle is one of this valid node. */
bool rclc_executor_handle_is_of(const rclc_executor_handle_t * handle, const rcl_node_t * node);

/* Returns RCL_RET_OK, or the error for executor or node, with a text. */
rcl_ret_t rclc_executor_nodes_check(const rclc_executor_t * executor, const rcl_node_t * node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_EXECUTOR_NODES_INTERNAL_H */
