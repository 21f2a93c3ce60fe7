/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_graph.h"
#include "microros/rcl_graph_scan.h"

typedef struct nodes_list_t {
  rcutils_string_array_t * nodes; /* first: a list with enclaves begins with one of these */
  rcutils_string_array_t * namespaces;
  const rcutils_allocator_t * allocator;
} nodes_list_t;

static void nodes_drop(void * list)
{
  const nodes_list_t * wanted = list;

  rcl_graph_clear(wanted->nodes, wanted->allocator);
  rcl_graph_clear(wanted->namespaces, wanted->allocator);
}

static rcl_ret_t nodes_scan(void * list, const rcl_graph_cdr_t * cdr, rcl_graph_part_t part)
{
  const nodes_list_t * wanted = list;
  const rcl_graph_text_t * node = &cdr->node;
  size_t slash = node->size;

  if (part != RCL_GRAPH_PART_NODE) {
    return RCL_RET_OK;
  }
  if (node->truncated) {
    return RCL_RET_ERROR;
  }
  while (slash != 0u && node->data[slash - 1u] != '/') { /* there is one: it follows the namespace */
    --slash;
  }
  /* The slash is the namespace of a node of the root, and ends all others. */
  return rcl_graph_add_text(wanted->nodes, &node->data[slash], node->size - slash) &&
             rcl_graph_add_text(wanted->namespaces, node->data, slash > 1u ? slash - 1u : 1u)
           ? RCL_RET_OK
           : RCL_RET_BAD_ALLOC;
}

rcl_ret_t rcl_graph_list_nodes(
  const rcutils_allocator_t * allocator, rcutils_string_array_t * nodes, rcutils_string_array_t * namespaces)
{
  static const rcl_graph_scanner_t scanner = {nodes_scan, nodes_drop};
  nodes_list_t list = {nodes, namespaces, allocator};

  return rcl_graph_scan(&scanner, &list, NULL);
}

/* Nodes with their enclaves. */
typedef struct enclaves_list_t {
  nodes_list_t nodes; /* first */
  rcutils_string_array_t * enclaves;
} enclaves_list_t;

static void enclaves_drop(void * list)
{
  const enclaves_list_t * wanted = list;

  nodes_drop(list);
  rcl_graph_clear(wanted->enclaves, wanted->nodes.allocator);
}

/* The sample has no enclaves: each is the one that a node has by default. */
static rcl_ret_t enclaves_scan(void * list, const rcl_graph_cdr_t * cdr, rcl_graph_part_t part)
{
  const enclaves_list_t * wanted = list;
  const rcl_ret_t result = nodes_scan(list, cdr, part);

  if (result != RCL_RET_OK || part != RCL_GRAPH_PART_NODE) {
    return result;
  }
  return rcl_graph_add_text(wanted->enclaves, "/", 1) ? RCL_RET_OK : RCL_RET_BAD_ALLOC;
}

rcl_ret_t rcl_graph_list_nodes_with_enclaves(
  const rcutils_allocator_t * allocator, rcutils_string_array_t * nodes, rcutils_string_array_t * namespaces,
  rcutils_string_array_t * enclaves)
{
  static const rcl_graph_scanner_t scanner = {enclaves_scan, enclaves_drop};
  enclaves_list_t list = {{nodes, namespaces, allocator}, enclaves};

  return rcl_graph_scan(&scanner, &list, NULL);
}
