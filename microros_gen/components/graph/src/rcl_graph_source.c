/* SPDX-License-Identifier: Apache-2.0 */
/* The endpoints for the graph server, in the first node. */
#include "microros/rcl_graph_server.h"

#include "microros/lock.h"
#include "microros/rcl_client_open.h"
#include "microros/rmw_node.h"
#include "microros/rmw_subscription.h"
#include "microros_graph_msgs/msg/change.h"
#include "rmw/qos_profiles.h"

rcl_client_t rcl_graph_names_client;
rcl_client_t rcl_graph_endpoints_client;

static rmw_subscription_t * graph_notices;

rcl_client_t rcl_graph_source_client(const rcl_client_t * client)
{
  rcl_client_t found;

  microros_lock();
  found = *client;
  microros_unlock();
  return found;
}

/* Makes a client the one that queries use, and returns the former one. */
static rcl_client_t graph_exchange(rcl_client_t * client, rcl_client_t next)
{
  rcl_client_t former;

  microros_lock();
  former = *client;
  *client = next;
  microros_unlock();
  return former;
}

static rcl_ret_t graph_open_client(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type,
  const char * name)
{
  rcl_client_t opened = rcl_get_zero_initialized_client();
  const rcl_ret_t result = rcl_client_open(&opened, node, type, name, &rmw_qos_profile_services_default);

  (void)graph_exchange(client, opened);
  return result;
}

static void graph_close_client(rcl_client_t * client, rcl_node_t * node)
{
  rcl_client_t former = graph_exchange(client, rcl_get_zero_initialized_client());

  (void)rcl_client_fini(&former, node); /* cannot fail: the node is open */
}

/* Makes a subscription the one that is followed, and returns the former one. */
static rmw_subscription_t * graph_follow(rmw_subscription_t * next)
{
  rmw_subscription_t * former;

  microros_lock();
  former = graph_notices;
  graph_notices = next;
  microros_unlock();
  return former;
}

static rcl_ret_t graph_open_notices(const rcl_node_t * node)
{
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rmw_subscription_t * opened = NULL;
  rmw_ret_t result;

  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  qos.depth = 1;
  result = rmw_subscription_open(
    node->impl, ROSIDL_GET_MSG_TYPE_SUPPORT(microros_graph_msgs, msg, Change), "/microros_graph/changes",
    &qos, &opened);
  (void)graph_follow(opened);
  return result;
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
  rmw_subscription_t * notices = graph_follow(NULL);

  if (rmw_subscription_is_open(notices)) {
    rmw_subscription_close(notices);
  }
  graph_close_client(&rcl_graph_names_client, node);
  graph_close_client(&rcl_graph_endpoints_client, node);
}

bool rcl_graph_source_is_open(void)
{
  const rcl_client_t client = rcl_graph_source_client(&rcl_graph_names_client);

  return rcl_client_is_valid(&client);
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
