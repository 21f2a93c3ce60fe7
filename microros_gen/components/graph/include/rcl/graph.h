/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Queries of the ROS graph. A graph server answers them (`microros-gen graph-server`, or one in the agent). With the
 * component `graph_topic` they are answered from the last sample of ros_to_microros_graph, which the agent sends once
 * more for each query. That sample has no QoS, type hash or GID (unknown, zero) and no names of DDS
 * (RCL_RET_UNSUPPORTED), so matched counts are those of endpoints of the same type.
 *
 * Every query waits at most MICROROS_CREATE_TIMEOUT_MS for each page of a list, or each fragment of the sample, without
 * calling callbacks. One task at a time may query; a second one gets RCL_RET_ERROR. Not for callbacks of the executor
 * that must not wait, and not for interrupts. Lists are memory of the given allocator, which the caller frees with the
 * functions below; the default allocator has `memory: {arena: N}` bytes. After an error nothing is allocated. Each code
 * except RCL_RET_OK has a text:
 *
 * RCL_RET_TIMEOUT: no answer of a server, or no sample.
 * RCL_RET_BAD_ALLOC: the list has no room.
 * RCL_RET_ERROR: a name is longer than `limits` of microros_graph_msgs (micro_ros_msgs), the session is lost, or the
 * graph changes faster than it is read.
 * RCL_RET_INVALID_ARGUMENT: an argument is NULL, an output is not zero-initialized, or a name is not fully qualified.
 * RCL_RET_UNSUPPORTED: `no_mangle` is true.
 * RCL_RET_NODE_NAME_NON_EXISTENT: the graph has no such node.
 * RCL_RET_NODE_INVALID_NAMESPACE, RCL_RET_NODE_INVALID_NAME: no node can have this name.
 */
#ifndef MICROROS_RCL_GRAPH_H
#define MICROROS_RCL_GRAPH_H

#include <stdbool.h>
#include <stddef.h>

#include "rcl/client.h"
#include "rcl/guard_condition.h"
#include "rcl/macros.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/subscription.h"
#include "rcl/visibility_control.h"
#include "rcutils/time.h"
#include "rcutils/types.h"
#include "rcutils/types/string_array.h"
#include "rmw/names_and_types.h"
#include "rmw/topic_endpoint_info_array.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef rmw_names_and_types_t rcl_names_and_types_t;
typedef rmw_topic_endpoint_info_t rcl_topic_endpoint_info_t;
typedef rmw_topic_endpoint_info_array_t rcl_topic_endpoint_info_array_t;

#define rcl_get_zero_initialized_names_and_types rmw_get_zero_initialized_names_and_types
#define rcl_get_zero_initialized_topic_endpoint_info_array rmw_get_zero_initialized_topic_endpoint_info_array
#define rcl_topic_endpoint_info_array_fini rmw_topic_endpoint_info_array_fini

/* --- lists of names --- */

rcl_ret_t rcl_get_topic_names_and_types(
  const rcl_node_t * node, rcl_allocator_t * allocator, bool no_demangle,
  rcl_names_and_types_t * topic_names_and_types);

rcl_ret_t rcl_get_service_names_and_types(
  const rcl_node_t * node, rcl_allocator_t * allocator, rcl_names_and_types_t * service_names_and_types);

/* Of a node by its name and namespace ("/", "" or "/a/b"). */
rcl_ret_t rcl_get_publisher_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, bool no_demangle, const char * node_name,
  const char * node_namespace, rcl_names_and_types_t * topic_names_and_types);

rcl_ret_t rcl_get_subscriber_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, bool no_demangle, const char * node_name,
  const char * node_namespace, rcl_names_and_types_t * topic_names_and_types);

rcl_ret_t rcl_get_service_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * node_name, const char * node_namespace,
  rcl_names_and_types_t * service_names_and_types);

rcl_ret_t rcl_get_client_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * node_name, const char * node_namespace,
  rcl_names_and_types_t * service_names_and_types);

rcl_ret_t rcl_names_and_types_init(
  rcl_names_and_types_t * names_and_types, size_t size, rcl_allocator_t * allocator);

rcl_ret_t rcl_names_and_types_fini(rcl_names_and_types_t * names_and_types);

/* Name i is in namespace i. */
rcl_ret_t rcl_get_node_names(
  const rcl_node_t * node, rcl_allocator_t allocator, rcutils_string_array_t * node_names,
  rcutils_string_array_t * node_namespaces);

/* As above, and enclave i of node i: "/", unless the node was started with another one. From ros_to_microros_graph, which
 * has no enclaves, always "/". */
rcl_ret_t rcl_get_node_names_with_enclaves(
  const rcl_node_t * node, rcl_allocator_t allocator, rcutils_string_array_t * node_names,
  rcutils_string_array_t * node_namespaces, rcutils_string_array_t * enclaves);

/* --- endpoints of a topic --- */

rcl_ret_t rcl_get_publishers_info_by_topic(
  const rcl_node_t * node, rcutils_allocator_t * allocator, const char * topic_name, bool no_mangle,
  rcl_topic_endpoint_info_array_t * publishers_info);

rcl_ret_t rcl_get_subscriptions_info_by_topic(
  const rcl_node_t * node, rcutils_allocator_t * allocator, const char * topic_name, bool no_mangle,
  rcl_topic_endpoint_info_array_t * subscriptions_info);

/* --- counts; these need no memory --- */

rcl_ret_t rcl_count_publishers(const rcl_node_t * node, const char * topic_name, size_t * count);
rcl_ret_t rcl_count_subscribers(const rcl_node_t * node, const char * topic_name, size_t * count);
rcl_ret_t rcl_count_clients(const rcl_node_t * node, const char * service_name, size_t * count);
rcl_ret_t rcl_count_services(const rcl_node_t * node, const char * service_name, size_t * count);

/*
 * Count what matches an own endpoint by type and QoS. If the node has several such endpoints on the topic,
 * what matches any of them counts. RCL_RET_ERROR while the server does not know the endpoint. */
rcl_ret_t rcl_publisher_get_subscription_count(
  const rcl_publisher_t * publisher, size_t * subscription_count);
rcl_ret_t rcl_subscription_get_publisher_count(
  const rcl_subscription_t * subscription, size_t * publisher_count);

/* Sets *is_available to whether the client's service has a server. */
rcl_ret_t rcl_service_server_is_available(
  const rcl_node_t * node, const rcl_client_t * client, bool * is_available);

/* --- changes --- */

/* Returns a guard condition that is triggered when the graph has changed; it belongs to the node. A wait
 * set needs room for it: `pools: {guard_conditions: 1}`. NULL for an invalid node. */
const rcl_guard_condition_t * rcl_node_get_graph_guard_condition(const rcl_node_t * node);

/*
 * Wait until the topic has `count` publishers or subscriptions. `timeout` is in nanoseconds. A negative one means no
 * timeout; 0 is a single query, which waits as the functions above do. Each query takes a round trip, so a shorter
 * timeout always expires. A query that fails is repeated: the server or the agent may restart meanwhile.
 * RCL_RET_TIMEOUT: *success is false; a text is set if the last query got no answer. RCL_RET_ERROR, with a text: the name
 * is too long, or the endpoints are closed. `allocator` is not used.
 */
rcl_ret_t rcl_wait_for_publishers(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * topic_name, const size_t count,
  rcutils_duration_value_t timeout, bool * success);

rcl_ret_t rcl_wait_for_subscribers(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * topic_name, const size_t count,
  rcutils_duration_value_t timeout, bool * success);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_H */
