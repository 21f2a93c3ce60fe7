/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph.h"
#include "microros/rmw_node.h"
#include "microros/rmw_publisher.h"
#include "microros/rmw_qos.h"
#include "microros/rmw_service.h"
#include "microros/rmw_subscription.h"
#include "microros/xrce_client.h"

#include <string.h>

static void counts_request(
  uint8_t what, char * name, microros_graph_msgs__srv__ListEndpoints_Request * request)
{
  (void)memset(request, 0, sizeof(*request));
  request->what = what;
  rcl_graph_lend(&request->name, name);
  rcl_graph_lend(&request->matched_by, NULL);
}

/* Asks for the number of endpoints of `name`. */
static rcl_ret_t counts_ask(
  const microros_graph_msgs__srv__ListEndpoints_Request * request, const char * name, size_t * count)
{
  microros_graph_msgs__srv__ListEndpoints_Response response;
  rcl_ret_t result = rcl_graph_begin();

  if (result != RCL_RET_OK) {
    return result;
  }
  (void)memset(&response, 0, sizeof(response)); /* has no endpoints: none are requested */
  result = rcl_graph_ask(&rcl_graph_endpoints_client, request, &response, NULL);
  rcl_graph_end();
  if (result == RCL_RET_OK) {
    result = rcl_graph_status(response.status, "an endpoint of the own node on", name);
  }
  if (result == RCL_RET_OK) {
    *count = response.total;
  }
  return result;
}

rcl_ret_t rcl_graph_count(uint8_t what, const char * name, size_t * count)
{
  const rmw_name_t parts = {{name, "", "", ""}};
  microros_graph_msgs__srv__ListEndpoints_Request request;
  char full[MICROROS_GRAPH_NAME_SIZE];
  const rcl_ret_t result = rcl_graph_write_name(&parts, full);

  if (result != RCL_RET_OK) {
    return result;
  }
  counts_request(what, full, &request);
  return counts_ask(&request, full, count);
}

static rcl_ret_t counts_of_name(const rcl_node_t * node, uint8_t what, const char * name, size_t * count)
{
  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (name == NULL || count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "name or count");
  }
  return rcl_graph_count(what, name, count);
}

rcl_ret_t rcl_count_publishers(const rcl_node_t * node, const char * topic_name, size_t * count)
{
  const uint8_t what = (uint8_t)microros_graph_msgs__srv__ListEndpoints_Request__PUBLISHERS;

  return counts_of_name(node, what, topic_name, count);
}

rcl_ret_t rcl_count_subscribers(const rcl_node_t * node, const char * topic_name, size_t * count)
{
  const uint8_t what = (uint8_t)microros_graph_msgs__srv__ListEndpoints_Request__SUBSCRIPTIONS;

  return counts_of_name(node, what, topic_name, count);
}

rcl_ret_t rcl_count_clients(const rcl_node_t * node, const char * service_name, size_t * count)
{
  const uint8_t what = (uint8_t)microros_graph_msgs__srv__ListEndpoints_Request__CLIENTS;

  return counts_of_name(node, what, service_name, count);
}

rcl_ret_t rcl_count_services(const rcl_node_t * node, const char * service_name, size_t * count)
{
  const uint8_t what = (uint8_t)microros_graph_msgs__srv__ListEndpoints_Request__SERVERS;

  return counts_of_name(node, what, service_name, count);
}

/* Counts what matches an own endpoint. DDS decides by QoS, so that names it among those of its node. */
static rcl_ret_t counts_matched(uint8_t what, const xrce_endpoint_t * own, size_t * count)
{
  const xrce_participant_t * participant = &own->client->participants[own->participant];
  const rmw_name_t node = rmw_name_of_topic(participant->name, participant->name, participant->namespace_);
  const rmw_name_t topic = {{own->name, "", "", ""}};
  char topic_full[MICROROS_GRAPH_NAME_SIZE];
  char node_full[MICROROS_GRAPH_NAME_SIZE];
  microros_graph_msgs__srv__ListEndpoints_Request request;
  rmw_qos_profile_t qos;
  rcl_ret_t result = rcl_graph_write_name(&topic, topic_full);

  if (result == RCL_RET_OK) {
    result = rcl_graph_write_name(&node, node_full);
  }
  if (result == RCL_RET_OK) {
    rmw_qos_actual(own, &qos);
    counts_request(what, topic_full, &request);
    rcl_graph_lend(&request.matched_by, node_full);
    request.reliability = (uint8_t)qos.reliability;
    request.durability = (uint8_t)qos.durability;
    request.deadline = (uint64_t)rmw_time_total_nsec(qos.deadline);
    result = counts_ask(&request, topic_full, count);
  }
  return result == RCL_RET_NODE_NAME_NON_EXISTENT ? RCL_RET_ERROR : result; /* not discovered yet */
}

rcl_ret_t rcl_publisher_get_subscription_count(const rcl_publisher_t * publisher, size_t * subscription_count)
{
  const uint8_t what = (uint8_t)microros_graph_msgs__srv__ListEndpoints_Request__SUBSCRIPTIONS;

  if (publisher == NULL || !rmw_publisher_is_open(publisher->impl)) {
    return microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
  }
  if (subscription_count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "subscription_count");
  }
  return counts_matched(what, publisher->impl->data, subscription_count);
}

rcl_ret_t rcl_subscription_get_publisher_count(
  const rcl_subscription_t * subscription, size_t * publisher_count)
{
  const uint8_t what = (uint8_t)microros_graph_msgs__srv__ListEndpoints_Request__PUBLISHERS;

  if (subscription == NULL || !rmw_subscription_is_open(subscription->impl)) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  if (publisher_count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "publisher_count");
  }
  return counts_matched(what, subscription->impl->data, publisher_count);
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
  result = rcl_count_services(node, client->impl->service_name, &servers);
  if (result == RCL_RET_OK) {
    *is_available = servers != 0u;
  }
  return result;
}
