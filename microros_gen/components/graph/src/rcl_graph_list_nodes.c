/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph_server.h"

#include <string.h>

/* Names of nodes: the request, and where they are stored. */
typedef struct nodes_list_t {
  rcl_graph_names_t names;
  rcutils_string_array_t * nodes;
  rcutils_string_array_t * namespaces;
  const rcl_allocator_t * allocator;
} nodes_list_t;

static rcl_ret_t nodes_ask(void * list, uint32_t first, rcl_graph_page_t * page)
{
  nodes_list_t * wanted = list;

  return rcl_graph_ask_names(&wanted->names, first, page);
}

static void nodes_drop(void * list)
{
  const nodes_list_t * wanted = list;

  /* Cannot fail: they were made with a valid allocator. */
  (void)rcutils_string_array_fini(wanted->nodes);
  (void)rcutils_string_array_fini(wanted->namespaces);
}

static rcl_ret_t nodes_make(void * list, size_t size)
{
  const nodes_list_t * wanted = list;

  if (
    rcutils_string_array_init(wanted->nodes, size, wanted->allocator) != RCUTILS_RET_OK ||
    rcutils_string_array_init(wanted->namespaces, size, wanted->allocator) != RCUTILS_RET_OK) {
    nodes_drop(list);
    return RCL_RET_BAD_ALLOC;
  }
  return RCL_RET_OK;
}

static rcl_ret_t nodes_put(void * list, size_t item, size_t index)
{
  const nodes_list_t * wanted = list;
  const rosidl_runtime_c__String * name = &wanted->names.response.names.data[item].name;

  return rcl_graph_split(
    name->data, name->size, wanted->allocator, &wanted->nodes->data[index], &wanted->namespaces->data[index]);
}

rcl_ret_t rcl_graph_list_nodes(
  const rcutils_allocator_t * allocator, rcutils_string_array_t * nodes, rcutils_string_array_t * namespaces)
{
  static const rcl_graph_reader_t reader = {nodes_ask, nodes_make, nodes_put, nodes_drop};
  nodes_list_t list;

  (void)memset(&list, 0, sizeof(list));
  list.names.what = RCL_GRAPH_NODES;
  list.nodes = nodes;
  list.namespaces = namespaces;
  list.allocator = allocator;
  return rcl_graph_read(&reader, &list);
}
