/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_graph_events.h"
#include "microros/rcl_graph_server.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_client.h"

#include <string.h>

bool rcl_graph_event_request(
  const rcl_graph_event_t * event, microros_graph_msgs__srv__EndpointStatus_Request * request)
{
  static char topic_full[MICROROS_GRAPH_NAME_SIZE];
  static char node_full[MICROROS_GRAPH_NAME_SIZE];
  const xrce_endpoint_t * const own = event->endpoint;
  const xrce_participant_t * const participant = &own->client->participants[own->participant];
  const rmw_name_t node = rmw_name_of_topic(participant->name, participant->name, participant->namespace_);
  const rmw_name_t topic = {{own->name, "", "", ""}};
  rmw_qos_profile_t qos;

  if (rmw_name_size(&topic) >= MICROROS_GRAPH_NAME_SIZE || rmw_name_size(&node) >= MICROROS_GRAPH_NAME_SIZE) {
    return false;
  }
  rmw_name_copy(&topic, topic_full);
  rmw_name_copy(&node, node_full);
  rmw_qos_actual(own, &qos);
  (void)memset(request, 0, sizeof(*request));
  rcl_graph_lend(&request->topic, topic_full);
  rcl_graph_lend(&request->node, node_full);
  request->subscription = own->index >= MICROROS_PUBLISHERS_MAX;
  request->reliability = (uint8_t)qos.reliability;
  request->durability = (uint8_t)qos.durability;
  request->deadline = (uint64_t)rmw_time_total_nsec(qos.deadline);
  request->newest = event->newest;
  return true;
}
