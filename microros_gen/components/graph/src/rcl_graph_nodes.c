/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph.h"

#include <stddef.h>

rcl_ret_t rcl_get_node_names(
  const rcl_node_t * node, rcl_allocator_t allocator, rcutils_string_array_t * node_names,
  rcutils_string_array_t * node_namespaces)
{
  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (
    !rcutils_allocator_is_valid(&allocator) || node_names == NULL || node_namespaces == NULL ||
    node_names->data != NULL || node_namespaces->data != NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "allocator, node_names or node_namespaces");
  }
  return rcl_graph_list_nodes(&allocator, node_names, node_namespaces);
}
