/* SPDX-License-Identifier: Apache-2.0 */
/* The endpoints for the graph server, in the first node. */
#include "microros/rcl_graph_server.h"

#include "microros/rcl_client_open.h"
#include "microros/rmw_node.h"
#include "microros/rmw_subscription.h"
#include "microros_graph_msgs/msg/change.h"
#include "rmw/qos_profiles.h"

rcl_client_t rcl_graph_names_client;
rcl_client_t rcl_graph_endpoints_client;

static rmw_subscription_t * graph_notices;

static rcl_ret_t graph_open_client(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type,
  const char * name)
{
  *client = rcl_get_zero_initialized_client();
  return rcl_client_open(client, node, type, name, &rmw_qos_profile_services_default);
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

rcl_ret_t rcl_graph_source_open(rcl_node_t * node)
{
  rcl_ret_t result = graph_open_notices(node);

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
  return result;
}

void rcl_graph_source_close(rcl_node_t * node)
{
  if (rmw_subscription_is_open(graph_notices)) {
    rmw_subscription_close(graph_notices);
  }
  /* Cannot fail: the node is open. */
  (void)rcl_client_fini(&rcl_graph_names_client, node);
  (void)rcl_client_fini(&rcl_graph_endpoints_client, node);
}

bool rcl_graph_source_is_open(void)
{
  return rcl_client_is_valid(&rcl_graph_names_client);
}

bool rcl_graph_source_has_changed(void)
{
  microros_graph_msgs__msg__Change notice;
  bool taken = false;

  if (!rmw_subscription_is_open(graph_notices) || !rmw_subscription_is_ready(graph_notices)) {
    return false;
  }
  /* A notice that cannot be read is counted for the subscription; the graph has changed all the same. */
  (void)rmw_subscription_take(graph_notices, &notice, &taken);
  return true;
}
