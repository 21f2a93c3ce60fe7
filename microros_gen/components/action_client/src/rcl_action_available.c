/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_action_available.h"

#include "microros/error.h"
#include "rcl/graph.h"

#include <stddef.h>

rcl_ret_t rcl_action_server_is_available(
  const rcl_node_t * node, const rcl_action_client_t * client, bool * is_available)
{
  size_t publishers = 0;
  bool is_there = false;
  rcl_ret_t result;

  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (!rcl_action_client_is_valid(client)) {
    return microros_error_refuse(RCL_RET_ACTION_CLIENT_INVALID, "client");
  }
  if (is_available == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "is_available");
  }
  result = rcl_service_server_is_available(node, &client->goal_client, &is_there);
  if (result == RCL_RET_OK && is_there) {
    result = rcl_service_server_is_available(node, &client->cancel_client, &is_there);
  }
  if (result == RCL_RET_OK && is_there) {
    result = rcl_service_server_is_available(node, &client->result_client, &is_there);
  }
  if (result == RCL_RET_OK && is_there) {
    result = rcl_count_publishers(
      node, rcl_subscription_get_topic_name(&client->feedback_subscription), &publishers);
  }
  if (result == RCL_RET_OK) {
    *is_available = is_there && publishers != 0u;
  }
  return result;
}
