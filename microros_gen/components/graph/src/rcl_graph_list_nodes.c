/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph_server.h"

#include <string.h>

rcl_ret_t rcl_graph_nodes_ask(void * list, uint32_t first, rcl_graph_page_t * page)
{
  rcl_graph_nodes_t * wanted = list;

  return rcl_graph_ask_names(&wanted->names, first, page);
}

void rcl_graph_nodes_drop(void * list)
{
  const rcl_graph_nodes_t * wanted = list;

  /* Cannot fail: they were made with a valid allocator. */
  (void)rcutils_string_array_fini(wanted->nodes);
  (void)rcutils_string_array_fini(wanted->namespaces);
}

rcl_ret_t rcl_graph_nodes_make(void * list, size_t size)
{
  const rcl_graph_nodes_t * wanted = list;

  if (
    rcutils_string_array_init(wanted->nodes, size, wanted->allocator) != RCUTILS_RET_OK ||
    rcutils_string_array_init(wanted->namespaces, size, wanted->allocator) != RCUTILS_RET_OK) {
    rcl_graph_nodes_drop(list);
    return RCL_RET_BAD_ALLOC;
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_graph_nodes_put(void * list, size_t item, size_t index)
{
  const rcl_graph_nodes_t * wanted = list;
  const rosidl_runtime_c__String * name = &wanted->names.response.names.data[item].name;

  return rcl_graph_split(
    name->data, name->size, wanted->allocator, &wanted->nodes->data[index], &wanted->namespaces->data[index]);
}

rcl_ret_t rcl_graph_list_nodes(
  const rcutils_allocator_t * allocator, rcutils_string_array_t * nodes, rcutils_string_array_t * namespaces)
{
  static const rcl_graph_reader_t reader = {
    rcl_graph_nodes_ask, rcl_graph_nodes_make, rcl_graph_nodes_put, rcl_graph_nodes_drop};
  rcl_graph_nodes_t list;

  (void)memset(&list, 0, sizeof(list));
  list.names.what = RCL_GRAPH_NODES;
  list.nodes = nodes;
  list.namespaces = namespaces;
  list.allocator = allocator;
  return rcl_graph_read(&reader, &list);
}
