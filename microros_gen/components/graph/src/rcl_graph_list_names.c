/* SPDX-License-Identifier: Apache-2.0 */
/* Lists of names with their types, of nodes, and of nodes with their enclaves. */
#include "microros/error.h"
#include "microros/rcl_graph_server.h"

#include <string.h>

/* A request for names, and the page of the last response. */
typedef struct names_page_t {
  char * node; /* fully qualified, for names of a node; otherwise NULL */
  rcl_graph_what_t what;
  uint16_t types_max;
  microros_graph_msgs__srv__ListNames_Response response;
} names_page_t;

/* Names with types: the request, and where they are stored. */
typedef struct names_list_t {
  names_page_t names; /* first: a list of names is one of these */
  rcl_names_and_types_t * into;
  rcl_allocator_t * allocator;
} names_list_t;

static microros_graph_msgs__msg__Name names_page[MICROROS_GRAPH_NAMES_MAX];

static void names_bind(void * response)
{
  static rosidl_runtime_c__String names_types[MICROROS_GRAPH_NAMES_MAX][MICROROS_GRAPH_TYPES_MAX];
  microros_graph_msgs__srv__ListNames_Response * names = response;
  size_t text = 0;

  for (size_t i = 0; i < MICROROS_GRAPH_NAMES_MAX; ++i) {
    rcl_graph_bind_text(&names_page[i].name, text++);
    for (size_t j = 0; j < MICROROS_GRAPH_TYPES_MAX; ++j) {
      rcl_graph_bind_text(&names_types[i][j], text++);
    }
    names_page[i].types.data = names_types[i];
    names_page[i].types.size = 0;
    names_page[i].types.capacity = MICROROS_GRAPH_TYPES_MAX;
  }
  names->names.data = names_page;
  names->names.size = 0;
  names->names.capacity = MICROROS_GRAPH_NAMES_MAX;
}

/* Asks for a page of names, after one of page->version. */
static rcl_ret_t names_ask_page(names_page_t * names, uint32_t first, rcl_graph_page_t * page)
{
  const microros_graph_msgs__srv__ListNames_Response * response = &names->response;
  microros_graph_msgs__srv__ListNames_Request request;
  rcl_ret_t result;

  (void)memset(&request, 0, sizeof(request));
  request.what = (uint8_t)names->what;
  rcl_graph_lend(&request.node, names->node);
  request.first = first;
  request.version = page->version;
  request.names_max = MICROROS_GRAPH_NAMES_MAX;
  request.name_size = MICROROS_GRAPH_NAME_SIZE;
  request.types_max = names->types_max;
  result = rcl_graph_ask(&rcl_graph_names_client, &request, &names->response, names_bind, NULL);
  if (result != RCL_RET_OK) {
    return result;
  }
  page->version = response->version;
  page->total = response->total;
  page->next = response->next;
  page->size = response->names.size;
  page->truncated = response->truncated;
  return rcl_graph_status(response->status, "the node", names->node);
}

static rcl_ret_t names_ask(void * list, uint32_t first, rcl_graph_page_t * page)
{
  names_list_t * wanted = list;

  return names_ask_page(&wanted->names, first, page);
}

static rcl_ret_t names_make(void * list, size_t size)
{
  const names_list_t * wanted = list;

  return rmw_names_and_types_init(wanted->into, size, wanted->allocator);
}

static rcl_ret_t names_put(void * list, size_t item, size_t index)
{
  const names_list_t * wanted = list;
  const microros_graph_msgs__msg__Name * name = &names_page[item];
  rcutils_string_array_t * types = &wanted->into->types[index];

  wanted->into->names.data[index] = rcl_graph_copy(name->name.data, name->name.size, wanted->allocator);
  if (
    wanted->into->names.data[index] == NULL ||
    rcutils_string_array_init(types, name->types.size, wanted->allocator) != RCUTILS_RET_OK) {
    return RCL_RET_BAD_ALLOC;
  }
  for (size_t i = 0; i < name->types.size; ++i) {
    types->data[i] = rcl_graph_copy(name->types.data[i].data, name->types.data[i].size, wanted->allocator);
    if (types->data[i] == NULL) {
      return RCL_RET_BAD_ALLOC;
    }
  }
  return RCL_RET_OK;
}

static void names_drop(void * list)
{
  const names_list_t * wanted = list;

  (void)rmw_names_and_types_fini(wanted->into); /* cannot fail: it was made with a valid allocator */
}

rcl_ret_t rcl_graph_list_names(
  rcl_graph_what_t what, char * node, rcutils_allocator_t * allocator, rcl_names_and_types_t * into)
{
  static const rcl_graph_reader_t reader = {names_ask, names_make, names_put, names_drop};
  names_list_t list;

  (void)memset(&list, 0, sizeof(list));
  list.names.what = what;
  list.names.node = node;
  list.names.types_max = MICROROS_GRAPH_TYPES_MAX;
  list.into = into;
  list.allocator = allocator;
  return rcl_graph_read(&reader, &list);
}

/* Names of nodes: the request, and where they are stored. */
typedef struct nodes_list_t {
  names_page_t names;
  rcutils_string_array_t * nodes;
  rcutils_string_array_t * namespaces;
  const rcl_allocator_t * allocator;
} nodes_list_t;

static rcl_ret_t nodes_ask(void * list, uint32_t first, rcl_graph_page_t * page)
{
  nodes_list_t * wanted = list;

  return names_ask_page(&wanted->names, first, page);
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

/* Nodes with their enclaves. */
typedef struct enclaves_list_t {
  nodes_list_t nodes; /* first: a list of nodes is one of these */
  rcutils_string_array_t * enclaves;
} enclaves_list_t;

static void enclaves_drop(void * list)
{
  const enclaves_list_t * wanted = list;

  nodes_drop(list);
  (void)rcutils_string_array_fini(wanted->enclaves); /* cannot fail: made with a valid allocator */
}

static rcl_ret_t enclaves_make(void * list, size_t size)
{
  const enclaves_list_t * wanted = list;
  const rcl_ret_t result = nodes_make(list, size);

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
  const rcl_ret_t result = nodes_put(list, item, index);

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
  static const rcl_graph_reader_t reader = {nodes_ask, enclaves_make, enclaves_put, enclaves_drop};
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
