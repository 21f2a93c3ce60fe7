/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_graph.h"
#include "microros/rcl_waiting.h"

/* Rests until the graph has changed since `seen`; false: the time is over. */
static bool wait_for_change(const rcl_waiting_t * waiting, uint32_t seen)
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

static rcl_ret_t wait_for_count(
  const rcl_node_t * node, uint8_t what, const char * topic_name, size_t count, int64_t timeout,
  bool * success)
{
  const rcl_waiting_t waiting = rcl_waiting_begin(timeout);

  if (!rcl_graph_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (topic_name == NULL || success == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "topic_name or success");
  }
  *success = false;
  for (;;) {
    const uint32_t seen = rcl_graph_changes(); /* before the query: what changes meanwhile is not missed */
    size_t found = 0;
    const rcl_ret_t result = rcl_graph_count(what, topic_name, &found);

    if (result != RCL_RET_OK) {
      return result == RCL_RET_TIMEOUT ? RCL_RET_ERROR : result; /* no server, whatever the topic has */
    }
    if (found >= count) {
      *success = true;
      return RCL_RET_OK;
    }
    if (!wait_for_change(&waiting, seen)) {
      return RCL_RET_TIMEOUT;
    }
  }
}

rcl_ret_t rcl_wait_for_publishers(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * topic_name, const size_t count,
  rcutils_duration_value_t timeout, bool * success)
{
  const uint8_t what = (uint8_t)microros_graph_msgs__srv__ListEndpoints_Request__PUBLISHERS;

  (void)allocator;
  return wait_for_count(node, what, topic_name, count, timeout, success);
}

rcl_ret_t rcl_wait_for_subscribers(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * topic_name, const size_t count,
  rcutils_duration_value_t timeout, bool * success)
{
  const uint8_t what = (uint8_t)microros_graph_msgs__srv__ListEndpoints_Request__SUBSCRIPTIONS;

  (void)allocator;
  return wait_for_count(node, what, topic_name, count, timeout, success);
}
