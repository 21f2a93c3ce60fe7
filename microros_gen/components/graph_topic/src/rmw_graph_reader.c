/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_graph_reader.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_node.h"
#include "microros/rmw_receiver.h"
#include "microros/xrce_client.h"
#include "microros/xrce_entities.h"
#include "microros/xrce_read.h"
#include "microros/xrce_wire.h"

/* Its samples are never encoded or decoded as a whole. */
static const microros_message_type_t graph_type = {
  MICROROS_FLASH_NAME("micro_ros_msgs::msg::dds_::Graph_"), 0, NULL, NULL, NULL};

static xrce_endpoint_t * reader_endpoint; /* NULL: never opened */

/* Takes the declared place, which the library alone uses. */
static rmw_ret_t reader_open(xrce_endpoint_t * wanted, const xrce_sink_t * sink)
{
  /* The name in DDS, without a prefix: it is no topic of ROS. */
  static const rmw_name_t name = {{"ros_to_microros_graph", "", "", ""}};
  const rmw_section_t section = {MICROROS_PUBLISHERS_MAX,
                                 MICROROS_SUBSCRIPTIONS_MAX,
                                 microros_error_subscription_undeclared,
                                 microros_error_subscription_open,
                                 microros_error_subscription_open,
                                 wanted->type->dds_type_name};

  if (!rmw_receiver_take(wanted, &section, &name, name.part[0])) {
    return RMW_RET_ERROR;
  }
  reader_endpoint = &wanted->client->endpoints[wanted->index];
  xrce_sinks_set(wanted, sink);
  return rmw_receiver_start(wanted);
}

rmw_ret_t rmw_graph_reader_open(const rmw_node_t * node, const xrce_sink_t * sink)
{
  xrce_endpoint_t wanted = {
    .client = node->context->impl,
    .type = &graph_type,
    .participant = rmw_node_index(node),
    .depth = 1,
    .qos = XRCE_QOS_RELIABLE | XRCE_QOS_TRANSIENT_LOCAL | XRCE_QOS_KEEP_LAST};
  rmw_ret_t result;

  microros_lock();
  result = reader_open(&wanted, sink);
  microros_unlock();
  return result;
}

void rmw_graph_reader_renew(void)
{
  microros_lock();
  xrce_read_open(reader_endpoint); /* what is still on its way is not requested any more */
  xrce_entities_add(reader_endpoint->client, (uint16_t)(MICROROS_NODES_MAX + reader_endpoint->index));
  microros_unlock();
}

void rmw_graph_reader_close(void)
{
  if (rmw_graph_reader_is_open()) {
    rmw_receiver_close(reader_endpoint);
  }
}

bool rmw_graph_reader_is_open(void)
{
  return reader_endpoint != NULL && rmw_receiver_is_open(reader_endpoint);
}
