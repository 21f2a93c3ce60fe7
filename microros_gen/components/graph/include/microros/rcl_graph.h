/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The functions of rcl/graph.h over one source of the graph: the graph server (rcl_graph_server.h), or with
 * the component `graph_topic` the topic of micro_ros_agent. Internal. */
#ifndef MICROROS_RCL_GRAPH_INTERNAL_H
#define MICROROS_RCL_GRAPH_INTERNAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/rcl_waiting.h"
#include "microros/rmw_names.h"
#include "microros/xrce_objects.h"
#include "microros_config.h"
#include "rcl/graph.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is listed; the values are those of microros_graph_msgs/srv/ListNames. */
typedef enum rcl_graph_what_t {
  RCL_GRAPH_NODES = 0,
  RCL_GRAPH_TOPICS = 1,
  RCL_GRAPH_SERVICES = 2,
  RCL_GRAPH_PUBLISHERS_OF_NODE = 3,
  RCL_GRAPH_SUBSCRIPTIONS_OF_NODE = 4,
  RCL_GRAPH_SERVICES_OF_NODE = 5,
  RCL_GRAPH_CLIENTS_OF_NODE = 6,
  RCL_GRAPH_DDS_TOPICS = 7,
  RCL_GRAPH_DDS_PUBLISHERS_OF_NODE = 8,
  RCL_GRAPH_DDS_SUBSCRIPTIONS_OF_NODE = 9,
  RCL_GRAPH_NODES_WITH_ENCLAVES = 10
} rcl_graph_what_t;

/* Endpoints; the values are those of microros_graph_msgs/srv/ListEndpoints and of micro_ros_msgs/msg/Entity. */
typedef enum rcl_graph_kind_t {
  RCL_GRAPH_PUBLISHERS = 0,
  RCL_GRAPH_SUBSCRIPTIONS = 1,
  RCL_GRAPH_SERVERS = 2,
  RCL_GRAPH_CLIENTS = 3
} rcl_graph_kind_t;

/* --- rcl_graph.c --- */

/* Returns whether a node is valid; if not, a text is set. */
bool rcl_graph_node_is_valid(const rcl_node_t * node);

/* Begins a query; RCL_RET_ERROR, with a text, if another one is made or the endpoints are closed. */
rcl_ret_t rcl_graph_begin(void);
void rcl_graph_end(void);

/* Writes a name of parts to `full`; RCL_RET_ERROR, with a text, if it is too long to be asked for. */
rcl_ret_t rcl_graph_write_name(const rmw_name_t * name, char full[MICROROS_GRAPH_NAME_SIZE]);

/* Begins to wait for at most `most_ms`, and not longer than `limit` has left; NULL: no limit. */
rcl_waiting_t rcl_graph_waiting(uint32_t most_ms, const rcl_waiting_t * limit);

/* Returns how long a query waited at most, for its text. */
uint32_t rcl_graph_waited_ms(const rcl_waiting_t * limit);

/* Returns a copy of `size` bytes and a NUL in memory of the allocator, or NULL. */
char * rcl_graph_copy(const char * text, size_t size, const rcutils_allocator_t * allocator);

/* Splits a fully qualified node name of `size` bytes: copies of its name and of its namespace, which is "/" for
 * the root. After an error, what is not NULL is the caller's. */
rcl_ret_t rcl_graph_split(
  const char * full, size_t size, const rcutils_allocator_t * allocator, char ** name, char ** namespace_);

/* Returns the code of a query that ended with `result`, with a text where the allocator has set none. */
rcl_ret_t rcl_graph_result(rcl_ret_t result);

/* Returns a counter of the changes of the graph. */
uint32_t rcl_graph_changes(void);

/* --- the source of the graph; a function that returns an error has set a text, and allocated nothing --- */

/* Opens its endpoints with a node, and waits for the agent; after an error the node is closed, and so are they. */
rcl_ret_t rcl_graph_source_open(rcl_node_t * node);
void rcl_graph_source_close(rcl_node_t * node);
bool rcl_graph_source_is_open(void);

/* Returns once for each change of the graph whether it has changed; called after receiving. */
bool rcl_graph_source_has_changed(void);

/* Returns RCL_RET_ERROR, with the text for a name that is too long. */
rcl_ret_t rcl_graph_source_refuse_long(void);

/* Lists names; `node` is the fully qualified one for names of a node, otherwise NULL. The other arguments are valid. */
rcl_ret_t rcl_graph_list_names(
  rcl_graph_what_t what, char * node, rcutils_allocator_t * allocator, rcl_names_and_types_t * into);

/* Lists the nodes; the arguments are valid. */
rcl_ret_t rcl_graph_list_nodes(
  const rcutils_allocator_t * allocator, rcutils_string_array_t * nodes, rcutils_string_array_t * namespaces);

/* Lists the nodes with their enclaves; the arguments are valid. */
rcl_ret_t rcl_graph_list_nodes_with_enclaves(
  const rcutils_allocator_t * allocator, rcutils_string_array_t * nodes, rcutils_string_array_t * namespaces,
  rcutils_string_array_t * enclaves);

/* Lists the publishers or subscriptions of a topic; the arguments are valid. */
rcl_ret_t rcl_graph_list_endpoints(
  rcl_graph_kind_t kind, char * topic, rcutils_allocator_t * allocator,
  rcl_topic_endpoint_info_array_t * into);

/* Counts the endpoints of a topic or service; `name` is fully qualified. RCL_RET_TIMEOUT also when `limit` has expired;
 * NULL: no limit. */
rcl_ret_t rcl_graph_count_named(
  rcl_graph_kind_t kind, char * name, const rcl_waiting_t * limit, size_t * count);

/* Counts the endpoints that match one of this node, which is of the other kind. */
rcl_ret_t rcl_graph_count_matched(rcl_graph_kind_t kind, const xrce_endpoint_t * own, size_t * count);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_INTERNAL_H */
