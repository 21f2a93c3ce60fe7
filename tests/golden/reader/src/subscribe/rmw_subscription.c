/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_subscription.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_local_take.h"
#include "microros/rmw_client.h"
#include "microros/rmw_node.h"
#include "microros/rmw_qos.h"
#include "microros/rmw_receiver.h"
#include "microros/xrce_client.h"
#include "microros/xrce_read.h"

#include <stddef.h>

static rmw_subscription_t * subscription_hand_out(xrce_endpoint_t * endpoint)
{
  static rmw_subscription_t subscriptions[MICROROS_SUBSCRIPTIONS_MAX]; /* indexed by place */
  rmw_subscription_t * subscription = &subscriptions[endpoint->index - MICROROS_PUBLISHERS_MAX];

  subscription->implementation_identifier = rmw_implementation_identifier;
  subscription->data = endpoint;
  subscription->topic_name = endpoint->name;
  return subscription;
}

static rmw_ret_t subscription_open_in(
  uint16_t first, uint16_t count, const rmw_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic, const rmw_qos_profile_t * qos, rmw_subscription_t ** subscription)
{
  const microros_message_type_t * type = type_support->data;
  const rmw_section_t section = {
    first,
    count,
    microros_error_subscription_undeclared,
    microros_error_subscription_open,
    microros_error_of_pool(microros_error_subscriptions_full, MICROROS_SUBSCRIPTIONS_MAX),
    type->dds_type_name};
  const rmw_name_t name = rmw_name_of_topic(topic, node->name, node->namespace_);
  xrce_endpoint_t wanted = {
    .client = node->context->impl, .type = type, .participant = rmw_node_index(node)};
  const char * refused = rmw_qos_to_xrce(qos, &wanted.qos, &wanted.depth);
  xrce_endpoint_t * endpoint = NULL;
  rmw_ret_t result;

  if (refused != NULL) {
    microros_error_set(microros_error_subscription_qos, topic, refused, 0, 0);
    return RMW_RET_UNSUPPORTED;
  }
  rmw_qos_add_times(qos, &wanted);
  result = rmw_receiver_open(&wanted, &section, &name, topic, &endpoint);
  if (result == RMW_RET_OK) {
    *subscription = subscription_hand_out(endpoint);
  }
  return result;
}

rmw_ret_t rmw_subscription_open(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, const char * topic,
  const rmw_qos_profile_t * qos, rmw_subscription_t ** subscription)
{
  return subscription_open_in(
    MICROROS_PUBLISHERS_MAX, MICROROS_SUBSCRIPTIONS_MAX, node, type_support, topic, qos, subscription);
}

void rmw_subscription_close(rmw_subscription_t * subscription)
{
  rmw_receiver_close(subscription->data);
}

bool rmw_subscription_is_open(const rmw_subscription_t * subscription)
{
  if (subscription == NULL || subscription->data == NULL) {
    return false;
  }
  return rmw_receiver_is_open(subscription->data);
}

bool rmw_subscription_is_ready(const rmw_subscription_t * subscription)
{
  bool ready;

  microros_lock();
  ready = rmw_local_is_ready(subscription->data) || xrce_read_is_ready(subscription->data);
  microros_unlock();
  return ready;
}

void rmw_subscription_pump(const rmw_subscription_t * subscription)
{
  const xrce_endpoint_t * endpoint = subscription->data;

  microros_lock();
  if (!rmw_local_may_wait(endpoint)) {
    xrce_session_pump(endpoint->client);
  }
  microros_unlock();
}
