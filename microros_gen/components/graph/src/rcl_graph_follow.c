/* SPDX-License-Identifier: Apache-2.0 */
/* The endpoints of the first node, and guard conditions that are triggered by notices of change. */
#include "microros/error.h"
#include "microros/rcl_graph.h"
#include "microros/rcl_graph_hooks.h"
#include "microros/rcl_guard_condition.h"
#include "microros/rmw_node.h"
#include "microros/rmw_subscription.h"
#include "microros_graph_msgs/msg/change.h"
#include "rmw/qos_profiles.h"

rcl_client_t rcl_graph_names_client;
rcl_client_t rcl_graph_endpoints_client;

static rmw_subscription_t * graph_notices;
static const rmw_node_t * graph_node; /* the owner of the endpoints */
static uint32_t graph_changes;

/* Indexed by node; taken while the node is open. */
static rcl_guard_condition_t graph_conditions[MICROROS_NODES_MAX];
static struct rcl_guard_condition_impl_s graph_triggers[MICROROS_NODES_MAX];

static rcl_ret_t graph_open_client(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type,
  const char * name)
{
  const rcl_client_options_t options = rcl_client_get_default_options();

  *client = rcl_get_zero_initialized_client();
  return rcl_client_init(client, node, type, name, &options);
}

static rcl_ret_t graph_open_notices(const rcl_node_t * node)
{
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  qos.depth = 1;
  return rmw_subscription_open(
    node->impl, ROSIDL_GET_MSG_TYPE_SUPPORT(microros_graph_msgs, msg, Change), "/microros_graph/changes",
    &qos, &graph_notices);
}

static rcl_ret_t graph_open(rcl_node_t * node)
{
  rcl_ret_t result;

  graph_node = node->impl;
  result = graph_open_notices(node);
  if (result == RCL_RET_OK) {
    result = graph_open_client(
      &rcl_graph_names_client, node, ROSIDL_GET_SRV_TYPE_SUPPORT(microros_graph_msgs, srv, ListNames),
      "/microros_graph/list_names");
  }
  if (result == RCL_RET_OK) {
    result = graph_open_client(
      &rcl_graph_endpoints_client, node, ROSIDL_GET_SRV_TYPE_SUPPORT(microros_graph_msgs, srv, ListEndpoints),
      "/microros_graph/list_endpoints");
  }
  return result; /* after an error the node is closed, and so are these */
}

rcl_ret_t rcl_graph_open(rcl_node_t * node)
{
  const uint16_t index = rmw_node_index(node->impl);

  graph_triggers[index].taken = true;
  graph_triggers[index].seen = graph_triggers[index].triggered;
  graph_conditions[index].impl = &graph_triggers[index];
  graph_conditions[index].context = node->context;
  return index == 0u ? graph_open(node) : RCL_RET_OK; /* declared with the first node */
}

void rcl_graph_close(rcl_node_t * node)
{
  graph_triggers[rmw_node_index(node->impl)].taken = false;
  if (graph_node != node->impl) {
    return;
  }
  if (rmw_subscription_is_open(graph_notices)) {
    rmw_subscription_close(graph_notices);
  }
  /* Cannot fail: the node is open. */
  (void)rcl_client_fini(&rcl_graph_names_client, node);
  (void)rcl_client_fini(&rcl_graph_endpoints_client, node);
  graph_node = NULL;
}

void rcl_graph_follow(void)
{
  microros_graph_msgs__msg__Change notice;
  bool taken = false;

  if (!rmw_subscription_is_open(graph_notices) || !rmw_subscription_is_ready(graph_notices)) {
    return;
  }
  /* A notice that cannot be read is counted for the subscription; the graph has changed all the same. */
  (void)rmw_subscription_take(graph_notices, &notice, &taken);
  ++graph_changes;
  for (size_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    if (graph_triggers[i].taken) {
      (void)rcl_trigger_guard_condition(&graph_conditions[i]); /* cannot fail: it is valid */
    }
  }
}

uint32_t rcl_graph_changes(void)
{
  return graph_changes;
}

const rcl_guard_condition_t * rcl_node_get_graph_guard_condition(const rcl_node_t * node)
{
  if (!rcl_graph_node_is_valid(node)) {
    return NULL;
  }
  return &graph_conditions[rmw_node_index(node->impl)];
}
