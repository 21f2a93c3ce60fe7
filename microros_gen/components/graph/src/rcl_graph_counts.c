/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph.h"
#include "microros/rmw_local_service.h"
#include "microros/rmw_peer_client.h"
#include "microros/rmw_publisher.h"
#include "microros/rmw_service.h"
#include "microros/rmw_subscription.h"

static rcl_ret_t counts_of_name(
  const rcl_node_t * node, rcl_graph_kind_t kind, const char * name, size_t * count)
{
  const rmw_name_t parts = {{name, "", "", ""}};
  char full[MICROROS_GRAPH_NAME_SIZE];
  rcl_ret_t result;

  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (name == NULL || count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "name or count");
  }
  result = rcl_graph_write_name(&parts, full);
  return result == RCL_RET_OK ? rcl_graph_count_named(kind, full, NULL, count) : result;
}

rcl_ret_t rcl_count_publishers(const rcl_node_t * node, const char * topic_name, size_t * count)
{
  return counts_of_name(node, RCL_GRAPH_PUBLISHERS, topic_name, count);
}

rcl_ret_t rcl_count_subscribers(const rcl_node_t * node, const char * topic_name, size_t * count)
{
  return counts_of_name(node, RCL_GRAPH_SUBSCRIPTIONS, topic_name, count);
}

rcl_ret_t rcl_count_clients(const rcl_node_t * node, const char * service_name, size_t * count)
{
  return counts_of_name(node, RCL_GRAPH_CLIENTS, service_name, count);
}

rcl_ret_t rcl_count_services(const rcl_node_t * node, const char * service_name, size_t * count)
{
  return counts_of_name(node, RCL_GRAPH_SERVERS, service_name, count);
}

rcl_ret_t rcl_publisher_get_subscription_count(const rcl_publisher_t * publisher, size_t * subscription_count)
{
  if (publisher == NULL || !rmw_publisher_is_open(publisher->impl)) {
    return microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
  }
  if (subscription_count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "subscription_count");
  }
  return rcl_graph_count_matched(RCL_GRAPH_SUBSCRIPTIONS, publisher->impl->data, subscription_count);
}

rcl_ret_t rcl_subscription_get_publisher_count(
  const rcl_subscription_t * subscription, size_t * publisher_count)
{
  if (subscription == NULL || !rmw_subscription_is_open(subscription->impl)) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  if (publisher_count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "publisher_count");
  }
  return rcl_graph_count_matched(RCL_GRAPH_PUBLISHERS, subscription->impl->data, publisher_count);
}

rcl_ret_t rcl_service_server_is_available(
  const rcl_node_t * node, const rcl_client_t * client, bool * is_available)
{
  size_t servers = 0;
  rcl_ret_t result;

  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (!rcl_client_is_valid(client) || is_available == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client or is_available");
  }
  if (
    rmw_local_server(client->impl->data, is_available) || rmw_peer_server(client->impl->data, is_available)) {
    return RCL_RET_OK;
  }
  result = rcl_count_services(node, client->impl->service_name, &servers);
  if (result == RCL_RET_OK) {
    *is_available = servers != 0u;
  }
  return result;
}
