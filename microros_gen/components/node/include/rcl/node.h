/* SPDX-License-Identifier: Apache-2.0 */
/* Nodes. Each has its own participant at the agent. */
#ifndef MICROROS_RCL_NODE_H
#define MICROROS_RCL_NODE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcl/allocator.h"
#include "rcl/arguments.h"
#include "rcl/context.h"
#include "rcl/macros.h"
#include "rcl/node_options.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_node_s rcl_node_impl_t;

typedef struct rcl_node_s {
  rcl_context_t * context;
  rcl_node_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_node_t;

rcl_node_t rcl_get_zero_initialized_node(void);

/*
 * Waits for the agent, at most MICROROS_CREATE_TIMEOUT_MS. With `nodes:` in the application file the node
 * must be declared there; otherwise it uses one of `pools: {nodes: N}`. RCL_RET_NODE_INVALID_NAME and
 * _NAMESPACE for names that ROS 2 refuses, RCL_RET_ALREADY_INIT, RCL_RET_NOT_INIT, RCL_RET_TIMEOUT,
 * otherwise RCL_RET_ERROR with a text.
 */
rcl_ret_t rcl_node_init(
  rcl_node_t * node, const char * name, const char * namespace_, rcl_context_t * context,
  const rcl_node_options_t * options);

/* Frees the places of the node and its publishers at once; waits for the agent, at most
 * MICROROS_CLOSE_TIMEOUT_MS. */
rcl_ret_t rcl_node_fini(rcl_node_t * node);

bool rcl_node_is_valid(const rcl_node_t * node);

bool rcl_node_is_valid_except_context(const rcl_node_t * node);

/* The names belong to the node; NULL for an invalid node. */
const char * rcl_node_get_name(const rcl_node_t * node);

const char * rcl_node_get_namespace(const rcl_node_t * node);

/*
 * Returns the name of the node's logger as rclcpp and rclpy have it: `name`, or `namespace.name`. It belongs to the node;
 * NULL for an invalid node. */
const char * rcl_node_get_logger_name(const rcl_node_t * node);

rcl_ret_t rcl_node_get_domain_id(const rcl_node_t * node, size_t * domain_id);

/*
 * Resolves a topic or service name of the source to its name in ROS 2: expands it as rcl_expand_topic_name
 * does, and unless `only_expand` is set, applies `remap:` of the application file. The result is a string
 * of `allocator`, which frees it. Codes of rcl_expand_topic_name, and RCL_RET_TOPIC_NAME_INVALID
 * (RCL_RET_SERVICE_NAME_INVALID with `is_service`) for an invalid result; RCL_RET_ERROR for an invalid
 * node.
 */
rcl_ret_t rcl_node_resolve_name(
  const rcl_node_t * node, const char * input_topic_name, rcl_allocator_t allocator, bool is_service,
  bool only_expand, char ** output_topic_name);

rmw_node_t * rcl_node_get_rmw_handle(const rcl_node_t * node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NODE_H */
