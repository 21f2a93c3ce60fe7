/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph_server.h"

#include <string.h>

/* Nodes with their enclaves. */
typedef struct enclaves_list_t {
  rcl_graph_nodes_t nodes; /* first: a list of nodes is one of these */
  rcutils_string_array_t * enclaves;
} enclaves_list_t;

static void enclaves_drop(void * list)
{
  const enclaves_list_t * wanted = list;

  rcl_graph_nodes_drop(list);
  (void)rcutils_string_array_fini(wanted->enclaves); /* cannot fail: made with a valid allocator */
}

static rcl_ret_t enclaves_make(void * list, size_t size)
{
  const enclaves_list_t * wanted = list;
  const rcl_ret_t result = rcl_graph_nodes_make(list, size);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (rcutils_string_array_init(wanted->enclaves, size, wanted->nodes.allocator) != RCUTILS_RET_OK) {
    enclaves_drop(list);
    return RCL_RET_BAD_ALLOC;
  }
  return RCL_RET_OK;
}

static rcl_ret_t enclaves_put(void * list, size_t item, size_t index)
{
  const enclaves_list_t * wanted = list;
  const rosidl_runtime_c__String__Sequence * types = &wanted->nodes.names.response.names.data[item].types;
  const rcl_ret_t result = rcl_graph_nodes_put(list, item, index);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (types->size != 1u) {
    return microros_error_named(RCL_RET_ERROR, microros_error_graph, "a node without an enclave");
  }
  wanted->enclaves->data[index] =
    rcl_graph_copy(types->data[0].data, types->data[0].size, wanted->nodes.allocator);
  return wanted->enclaves->data[index] != NULL ? RCL_RET_OK : RCL_RET_BAD_ALLOC;
}

rcl_ret_t rcl_graph_list_nodes_with_enclaves(
  const rcutils_allocator_t * allocator, rcutils_string_array_t * nodes, rcutils_string_array_t * namespaces,
  rcutils_string_array_t * enclaves)
{
  static const rcl_graph_reader_t reader = {rcl_graph_nodes_ask, enclaves_make, enclaves_put, enclaves_drop};
  enclaves_list_t list;

  (void)memset(&list, 0, sizeof(list));
  list.nodes.names.what = RCL_GRAPH_NODES_WITH_ENCLAVES;
  list.nodes.names.types_max = 1;
  list.nodes.nodes = nodes;
  list.nodes.namespaces = namespaces;
  list.nodes.allocator = allocator;
  list.enclaves = enclaves;
  return rcl_graph_read(&reader, &list);
}
