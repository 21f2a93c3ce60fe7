/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph.h"

#include <stddef.h>

static bool enclaves_is_zero(const rcutils_string_array_t * array)
{
  return array != NULL && array->data == NULL;
}

rcl_ret_t rcl_get_node_names_with_enclaves(
  const rcl_node_t * node, rcl_allocator_t allocator, rcutils_string_array_t * node_names,
  rcutils_string_array_t * node_namespaces, rcutils_string_array_t * enclaves)
{
  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (
    !rcutils_allocator_is_valid(&allocator) || !enclaves_is_zero(node_names) ||
    !enclaves_is_zero(node_namespaces) || !enclaves_is_zero(enclaves)) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "allocator, node_names, node_namespaces or enclaves");
  }
  return rcl_graph_list_nodes_with_enclaves(&allocator, node_names, node_namespaces, enclaves);
}
