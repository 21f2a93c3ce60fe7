/* SPDX-License-Identifier: Apache-2.0 */
/* Names with their types, nodes and endpoints, as the application asks for them. */
#include "microros/error.h"
#include "microros/rcl_graph.h"
#include "microros/rcl_names_given.h"

#include <stddef.h>

static rcl_ret_t names_check_arguments(
  const rcl_node_t * node, const rcl_allocator_t * allocator, rcl_names_and_types_t * into)
{
  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (!rcutils_allocator_is_valid(allocator) || rmw_names_and_types_check_zero(into) != RMW_RET_OK) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "allocator or names_and_types");
  }
  return RCL_RET_OK;
}

static rcl_ret_t names_read(
  const rcl_node_t * node, rcl_allocator_t * allocator, rcl_graph_what_t what, rcl_names_and_types_t * into)
{
  const rcl_ret_t result = names_check_arguments(node, allocator, into);

  return result == RCL_RET_OK ? rcl_graph_list_names(what, NULL, allocator, into) : result;
}

rcl_ret_t rcl_get_topic_names_and_types(
  const rcl_node_t * node, rcl_allocator_t * allocator, bool no_demangle,
  rcl_names_and_types_t * topic_names_and_types)
{
  const rcl_graph_what_t what = no_demangle ? RCL_GRAPH_DDS_TOPICS : RCL_GRAPH_TOPICS;

  return names_read(node, allocator, what, topic_names_and_types);
}

rcl_ret_t rcl_get_service_names_and_types(
  const rcl_node_t * node, rcl_allocator_t * allocator, rcl_names_and_types_t * service_names_and_types)
{
  return names_read(node, allocator, RCL_GRAPH_SERVICES, service_names_and_types);
}

/* In the order of rcl, which needs the slash at the start. */
static rcl_ret_t names_check_node(const char * name, const char * namespace_)
{
  const char * fault = namespace_[0] == '/' ? rcl_names_given_namespace(namespace_)
                                            : MICROROS_ERROR_WORDS("a namespace begins with /");

  if (fault != NULL) {
    microros_error_set(microros_error_name, namespace_, fault, 0, 0);
    return RCL_RET_NODE_INVALID_NAMESPACE;
  }
  fault = rcl_names_given_node(name);
  if (fault != NULL) {
    microros_error_set(microros_error_name, name, fault, 0, 0);
    return RCL_RET_NODE_INVALID_NAME;
  }
  return RCL_RET_OK;
}

/* Writes the fully qualified name of a node; an empty namespace is the root. */
static rcl_ret_t names_write_node(
  const char * name, const char * namespace_, char full[MICROROS_GRAPH_NAME_SIZE])
{
  const char * valid = namespace_[0] == '\0' ? "/" : namespace_;
  const rcl_ret_t result = names_check_node(name, valid);

  if (result == RCL_RET_OK) {
    const rmw_name_t parts = {{valid[1] == '\0' ? "" : valid, "/", name, ""}};

    return rcl_graph_write_name(&parts, full);
  }
  return result;
}

static rcl_ret_t names_of_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, rcl_graph_what_t what, const char * node_name,
  const char * node_namespace, rcl_names_and_types_t * into)
{
  char full[MICROROS_GRAPH_NAME_SIZE];
  rcl_ret_t result = names_check_arguments(node, allocator, into);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (node_name == NULL || node_namespace == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "node_name or node_namespace");
  }
  result = names_write_node(node_name, node_namespace, full);
  return result == RCL_RET_OK ? rcl_graph_list_names(what, full, allocator, into) : result;
}

rcl_ret_t rcl_get_publisher_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, bool no_demangle, const char * node_name,
  const char * node_namespace, rcl_names_and_types_t * topic_names_and_types)
{
  const rcl_graph_what_t what = no_demangle ? RCL_GRAPH_DDS_PUBLISHERS_OF_NODE : RCL_GRAPH_PUBLISHERS_OF_NODE;

  return names_of_node(node, allocator, what, node_name, node_namespace, topic_names_and_types);
}

rcl_ret_t rcl_get_subscriber_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, bool no_demangle, const char * node_name,
  const char * node_namespace, rcl_names_and_types_t * topic_names_and_types)
{
  const rcl_graph_what_t what =
    no_demangle ? RCL_GRAPH_DDS_SUBSCRIPTIONS_OF_NODE : RCL_GRAPH_SUBSCRIPTIONS_OF_NODE;

  return names_of_node(node, allocator, what, node_name, node_namespace, topic_names_and_types);
}

rcl_ret_t rcl_get_service_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * node_name, const char * node_namespace,
  rcl_names_and_types_t * service_names_and_types)
{
  return names_of_node(
    node, allocator, RCL_GRAPH_SERVICES_OF_NODE, node_name, node_namespace, service_names_and_types);
}

rcl_ret_t rcl_get_client_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * node_name, const char * node_namespace,
  rcl_names_and_types_t * service_names_and_types)
{
  return names_of_node(
    node, allocator, RCL_GRAPH_CLIENTS_OF_NODE, node_name, node_namespace, service_names_and_types);
}

rcl_ret_t rcl_names_and_types_init(
  rcl_names_and_types_t * names_and_types, size_t size, rcl_allocator_t * allocator)
{
  return rmw_names_and_types_init(names_and_types, size, allocator);
}

rcl_ret_t rcl_names_and_types_fini(rcl_names_and_types_t * names_and_types)
{
  return rmw_names_and_types_fini(names_and_types);
}

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

static rcl_ret_t endpoints_read(
  const rcl_node_t * node, rcutils_allocator_t * allocator, const char * topic_name, bool no_mangle,
  rcl_graph_kind_t kind, rcl_topic_endpoint_info_array_t * into)
{
  const rmw_name_t topic = {{topic_name, "", "", ""}};
  char full[MICROROS_GRAPH_NAME_SIZE];
  rcl_ret_t result;

  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (
    topic_name == NULL || !rcutils_allocator_is_valid(allocator) || into == NULL ||
    into->info_array != NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "topic_name, allocator or endpoints");
  }
  if (no_mangle) {
    return microros_error_named(RCL_RET_UNSUPPORTED, microros_error_graph, "no_mangle is not supported");
  }
  result = rcl_graph_write_name(&topic, full);
  return result == RCL_RET_OK ? rcl_graph_list_endpoints(kind, full, allocator, into) : result;
}

rcl_ret_t rcl_get_publishers_info_by_topic(
  const rcl_node_t * node, rcutils_allocator_t * allocator, const char * topic_name, bool no_mangle,
  rcl_topic_endpoint_info_array_t * publishers_info)
{
  return endpoints_read(node, allocator, topic_name, no_mangle, RCL_GRAPH_PUBLISHERS, publishers_info);
}

rcl_ret_t rcl_get_subscriptions_info_by_topic(
  const rcl_node_t * node, rcutils_allocator_t * allocator, const char * topic_name, bool no_mangle,
  rcl_topic_endpoint_info_array_t * subscriptions_info)
{
  return endpoints_read(node, allocator, topic_name, no_mangle, RCL_GRAPH_SUBSCRIPTIONS, subscriptions_info);
}
