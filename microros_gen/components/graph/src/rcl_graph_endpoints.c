/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph.h"

#include <stddef.h>

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
