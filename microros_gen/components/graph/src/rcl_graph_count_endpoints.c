/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph_server.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_client.h"

#include <string.h>

static void counts_request(
  rcl_graph_kind_t kind, char * name, microros_graph_msgs__srv__ListEndpoints_Request * request)
{
  (void)memset(request, 0, sizeof(*request));
  request->what = (uint8_t)kind;
  rcl_graph_lend(&request->name, name);
  rcl_graph_lend(&request->matched_by, NULL);
}

/* Asks for the number of endpoints of `name`. */
static rcl_ret_t counts_ask(
  const microros_graph_msgs__srv__ListEndpoints_Request * request, const char * name,
  const rcl_waiting_t * limit, size_t * count)
{
  microros_graph_msgs__srv__ListEndpoints_Response response;
  rcl_ret_t result = rcl_graph_begin();

  if (result != RCL_RET_OK) {
    return result;
  }
  (void)memset(&response, 0, sizeof(response)); /* has no endpoints: none are requested */
  result = rcl_graph_ask(&rcl_graph_endpoints_client, request, &response, NULL, limit);
  rcl_graph_end();
  if (result == RCL_RET_OK) {
    result = rcl_graph_status(response.status, "an endpoint of the own node on", name);
  }
  if (result == RCL_RET_OK) {
    *count = (size_t)response.total;
  }
  return result;
}

rcl_ret_t rcl_graph_count_named(
  rcl_graph_kind_t kind, char * name, const rcl_waiting_t * limit, size_t * count)
{
  microros_graph_msgs__srv__ListEndpoints_Request request;

  counts_request(kind, name, &request);
  return counts_ask(&request, name, limit, count);
}

/* Counts what matches an own endpoint. DDS decides by QoS, so that names it among those of its node. */
rcl_ret_t rcl_graph_count_matched(rcl_graph_kind_t kind, const xrce_endpoint_t * own, size_t * count)
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
    counts_request(kind, topic_full, &request);
    rcl_graph_lend(&request.matched_by, node_full);
    request.reliability = (uint8_t)qos.reliability;
    request.durability = (uint8_t)qos.durability;
    request.deadline = (uint64_t)rmw_time_total_nsec(qos.deadline);
    result = counts_ask(&request, topic_full, NULL, count);
  }
  return result == RCL_RET_NODE_NAME_NON_EXISTENT ? RCL_RET_ERROR : result; /* not discovered yet */
}
