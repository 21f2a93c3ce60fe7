/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph.h"
#include "microros/rcl_graph_scan.h"
#include "microros/text.h"

typedef struct names_list_t {
  const char * node; /* of names of a node, otherwise NULL */
  rcl_names_and_types_t * into;
  rcutils_allocator_t * allocator;
  size_t current; /* the entity that is read; the number of names: it is not listed */
  uint8_t kinds;  /* bit k: entities of rcl_graph_kind_t k are listed */
  bool is_known;  /* the node was found */
} names_list_t;

static void names_drop(void * list)
{
  names_list_t * wanted = list;

  if (wanted->into->types != NULL) {
    (void)rmw_names_and_types_fini(wanted->into); /* cannot fail: the allocator is valid */
  }
  rcl_graph_clear(&wanted->into->names, wanted->allocator);
  wanted->is_known = false;
}

static bool names_include(const names_list_t * wanted, const rcl_graph_cdr_t * cdr)
{
  return wanted->node == NULL || rcl_graph_text_equals(&cdr->node, wanted->node);
}

/* Returns the index of a text, or the size of the array. */
static size_t names_find(const rcutils_string_array_t * array, const char * text)
{
  size_t i = 0;

  while (i < array->size && !microros_text_equals(array->data[i], text)) {
    ++i;
  }
  return i;
}

static rcl_ret_t names_add(const names_list_t * wanted, const rcl_graph_text_t * name)
{
  rcl_names_and_types_t * into = wanted->into;
  void * types = into->types;

  if (!rcl_graph_grow(&types, into->names.size, sizeof(rcutils_string_array_t), wanted->allocator)) {
    return RCL_RET_BAD_ALLOC;
  }
  into->types = types;
  into->types[into->names.size] = rcutils_get_zero_initialized_string_array();
  into->types[into->names.size].allocator = *wanted->allocator;
  return rcl_graph_add_text(&into->names, name->data, name->size) ? RCL_RET_OK : RCL_RET_BAD_ALLOC;
}

static rcl_ret_t names_scan_entity(names_list_t * wanted, const rcl_graph_cdr_t * cdr)
{
  const rcutils_string_array_t * names = &wanted->into->names;
  const bool listed = cdr->kind <= (uint8_t)RCL_GRAPH_CLIENTS &&
                      (((uint32_t)wanted->kinds >> cdr->kind) & 1u) != 0u && names_include(wanted, cdr);

  wanted->current = names->size;
  if (!listed) {
    return RCL_RET_OK;
  }
  if (cdr->entity.truncated) {
    return RCL_RET_ERROR;
  }
  wanted->current = names_find(names, cdr->entity.data);
  return wanted->current == names->size ? names_add(wanted, &cdr->entity) : RCL_RET_OK;
}

static rcl_ret_t names_scan_type(const names_list_t * wanted, const rcl_graph_text_t * type)
{
  rcutils_string_array_t * types;

  if (wanted->current == wanted->into->names.size) {
    return RCL_RET_OK;
  }
  if (type->truncated) {
    return RCL_RET_ERROR;
  }
  types = &wanted->into->types[wanted->current];
  if (names_find(types, type->data) != types->size) {
    return RCL_RET_OK;
  }
  return rcl_graph_add_text(types, type->data, type->size) ? RCL_RET_OK : RCL_RET_BAD_ALLOC;
}

static rcl_ret_t names_scan(void * list, const rcl_graph_cdr_t * cdr, rcl_graph_part_t part)
{
  names_list_t * wanted = list;
  rcl_ret_t result = RCL_RET_OK;

  switch (part) {
    case RCL_GRAPH_PART_NODE:
      wanted->is_known = wanted->is_known || names_include(wanted, cdr);
      break;
    case RCL_GRAPH_PART_ENTITY:
      result = names_scan_entity(wanted, cdr);
      break;
    case RCL_GRAPH_PART_TYPE:
    default:
      result = names_scan_type(wanted, &cdr->type);
      break;
  }
  return result;
}

/* Returns the kinds of entities that are listed; 0: the topic does not tell. */
static uint8_t names_kinds(rcl_graph_what_t what)
{
  /* Bit k: rcl_graph_kind_t k. */
  enum {
    PUBLISHERS = 0x01,
    SUBSCRIPTIONS = 0x02,
    TOPICS = 0x03,
    SERVERS = 0x04,
    CLIENTS = 0x08,
    SERVICES = 0x0c
  };

  switch (what) {
    case RCL_GRAPH_TOPICS:
      return TOPICS;
    case RCL_GRAPH_SERVICES:
      return SERVICES;
    case RCL_GRAPH_PUBLISHERS_OF_NODE:
      return PUBLISHERS;
    case RCL_GRAPH_SUBSCRIPTIONS_OF_NODE:
      return SUBSCRIPTIONS;
    case RCL_GRAPH_SERVICES_OF_NODE:
      return SERVERS;
    case RCL_GRAPH_CLIENTS_OF_NODE:
      return CLIENTS;
    case RCL_GRAPH_NODES:
    case RCL_GRAPH_DDS_TOPICS:
    case RCL_GRAPH_DDS_PUBLISHERS_OF_NODE:
    case RCL_GRAPH_DDS_SUBSCRIPTIONS_OF_NODE:
    case RCL_GRAPH_NODES_WITH_ENCLAVES:
    default:
      return 0;
  }
}

rcl_ret_t rcl_graph_list_names(
  rcl_graph_what_t what, char * node, rcutils_allocator_t * allocator, rcl_names_and_types_t * into)
{
  static const rcl_graph_scanner_t scanner = {names_scan, names_drop};
  names_list_t list = {node, into, allocator, 0, names_kinds(what), false};
  rcl_ret_t result;

  if (list.kinds == 0u) {
    return microros_error_named(
      RCL_RET_UNSUPPORTED, microros_error_graph, "the topic has no names of DDS: use a graph server");
  }
  result = rcl_graph_scan(&scanner, &list, NULL);
  if (result == RCL_RET_OK && node != NULL && !list.is_known) {
    names_drop(&list);
    microros_error_set(microros_error_graph_node, node, "the node", 0, 0);
    return RCL_RET_NODE_NAME_NON_EXISTENT;
  }
  return result;
}

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
