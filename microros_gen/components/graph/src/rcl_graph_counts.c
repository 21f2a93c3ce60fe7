/* SPDX-License-Identifier: Apache-2.0 */
/* Counts of endpoints, and waiting for them. */
#include "microros/error.h"
#include "microros/rcl_graph.h"
#include "microros/rmw_local_service.h"
#include "microros/rmw_peer_client.h"
#include "microros/rmw_publisher.h"
#include "microros/rmw_service.h"
#include "microros/rmw_subscription.h"
#include "rcl/error_handling.h"

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

static const int64_t wait_retry_ns = 100000000; /* after a query that failed */

/* Rests until the graph has changed since `seen`; false: the time is over. */
static bool wait_for_change(rcl_waiting_t * waiting, uint32_t seen)
{
  while (rcl_graph_changes() == seen) {
    if (rcl_waiting_is_over(waiting)) {
      return false;
    }
    rcl_waiting_rest(waiting, INT64_MAX);
    rcl_waiting_receive();
  }
  return true;
}

/* A server or an agent that is silent, or restarts, may be there later; what is closed is not opened again. */
static bool wait_can_continue(rcl_ret_t result)
{
  return result == RCL_RET_TIMEOUT || (result == RCL_RET_ERROR && rcl_graph_source_is_open());
}

static void wait_for_retry(rcl_waiting_t * waiting)
{
  rcutils_reset_error();
  rcl_waiting_rest(waiting, wait_retry_ns);
  rcl_waiting_receive();
}

static rcl_ret_t wait_until(
  rcl_graph_kind_t kind, char * topic, size_t count, rcl_waiting_t * waiting, bool * success)
{
  /* A program that waits for 0 ns asks how it is now, which takes the time of a query. */
  const rcl_waiting_t * const limit = waiting->timeout_ms == 0u ? NULL : waiting;

  for (;;) {
    const uint32_t seen = rcl_graph_changes(); /* before the query: what changes meanwhile is not missed */
    size_t found = 0;
    const rcl_ret_t result = rcl_graph_count_named(kind, topic, limit, &found);

    *success = result == RCL_RET_OK && found >= count;
    if (*success) {
      return RCL_RET_OK;
    }
    if (result == RCL_RET_OK) {
      if (!wait_for_change(waiting, seen)) {
        return RCL_RET_TIMEOUT;
      }
    } else if (!wait_can_continue(result)) {
      return result;
    } else if (rcl_waiting_is_over(waiting)) {
      return RCL_RET_TIMEOUT; /* with the text of the query */
    } else {
      wait_for_retry(waiting);
    }
  }
}

static rcl_ret_t wait_for_count(
  const rcl_node_t * node, rcl_graph_kind_t kind, const char * topic_name, size_t count, int64_t timeout,
  bool * success)
{
  rcl_waiting_t waiting = rcl_waiting_begin(timeout);
  const rmw_name_t name = {{topic_name, "", "", ""}};
  char topic[MICROROS_GRAPH_NAME_SIZE];
  rcl_ret_t result;

  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (topic_name == NULL || success == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "topic_name or success");
  }
  *success = false;
  result = rcl_graph_write_name(&name, topic);
  return result == RCL_RET_OK ? wait_until(kind, topic, count, &waiting, success) : result;
}

rcl_ret_t rcl_wait_for_publishers(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * topic_name, const size_t count,
  rcutils_duration_value_t timeout, bool * success)
{
  (void)allocator;
  return wait_for_count(node, RCL_GRAPH_PUBLISHERS, topic_name, count, timeout, success);
}

rcl_ret_t rcl_wait_for_subscribers(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * topic_name, const size_t count,
  rcutils_duration_value_t timeout, bool * success)
{
  (void)allocator;
  return wait_for_count(node, RCL_GRAPH_SUBSCRIPTIONS, topic_name, count, timeout, success);
}
