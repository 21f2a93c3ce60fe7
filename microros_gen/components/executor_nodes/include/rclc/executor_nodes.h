/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Nodes of an executor. The handles of a node are those of its subscriptions, services and clients, and of
 * the timers and guard conditions that rclc_executor_set_node assigned to it. Nodes that are to be updated
 * together form a group: the nodes of one executor.
 *
 * All functions belong to the task that spins the executor, callbacks included: a handle that is removed or
 * moved has no more turn in the round, one that is added has its first turn in the next round. They return
 * RCL_RET_INVALID_ARGUMENT for NULL, RCL_RET_NODE_INVALID, and RCL_RET_ERROR, with a text, for an executor
 * that is not initialized and in the cases below; then nothing has changed.
 */
#ifndef MICROROS_RCLC_EXECUTOR_NODES_H
#define MICROROS_RCLC_EXECUTOR_NODES_H

#include <stddef.h>

#include "rcl/node.h"
#include "rclc/executor.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Handles of a node: those that have a turn in each round, and those that rclc_executor_remove_node has put
 * aside. Both 0: the executor does not have the node. */
typedef struct rclc_executor_node_info_t {
  size_t running;
  size_t removed;
} rclc_executor_node_info_t;

/*
 * Assigns the handle of `entity` (an rcl_timer_t or rcl_guard_condition_t) to the node, whose address must
 * stay valid. RCL_RET_ERROR: the executor does not run it. */
rcl_ret_t rclc_executor_set_node(rclc_executor_t * executor, const void * entity, const rcl_node_t * node);

/*
 * Puts the node's handles aside: they keep their callbacks and their places in the pool, but the executor
 * neither waits for them nor shows them to its trigger function. Their messages wait in their queues.
 * RCL_RET_ERROR: the executor runs no handle of the node. rclc_executor_fini frees them, too.
 */
rcl_ret_t rclc_executor_remove_node(rclc_executor_t * executor, const rcl_node_t * node);

/*
 * Adds the handles again that rclc_executor_remove_node has put aside, after the others, in their former
 * order. RCL_RET_ERROR: it has put none aside. */
rcl_ret_t rclc_executor_add_node(rclc_executor_t * executor, const rcl_node_t * node);

/*
 * Moves the node's running handles to `other`, after its own, in their order. RCL_RET_ERROR: it runs none,
 * or `other` has fewer free places. No other task may spin one of the two executors meanwhile. A parameter
 * client is not moved so: remove it from one executor and add it to the other.
 */
rcl_ret_t rclc_executor_move_node(
  rclc_executor_t * executor, const rcl_node_t * node, rclc_executor_t * other);

rcl_ret_t rclc_executor_query_node(
  const rclc_executor_t * executor, const rcl_node_t * node, rclc_executor_node_info_t * info);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_EXECUTOR_NODES_H */
