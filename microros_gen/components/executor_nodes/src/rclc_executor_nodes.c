/* SPDX-License-Identifier: Apache-2.0 */
/* An executor's array: handles in use, free ones, and from max_handles on those of removed nodes. So the
 * executor itself knows nothing of removed nodes. */
#include "rclc/executor_nodes.h"

#include "microros/error.h"
#include "microros/executor_nodes.h"
#include "microros_config.h"

/* Returns the executor's counter of this type of handles. */
static size_t * nodes_counter(rclc_executor_handle_counters_t * info, rclc_executor_handle_type_t type)
{
  switch (type) {
    case RCLC_SUBSCRIPTION:
    case RCLC_SUBSCRIPTION_WITH_CONTEXT:
      return &info->number_of_subscriptions;
    case RCLC_TIMER:
      return &info->number_of_timers;
    case RCLC_CLIENT:
    case RCLC_CLIENT_WITH_REQUEST_ID:
      return &info->number_of_clients;
    case RCLC_ACTION_CLIENT:
      return &info->number_of_action_clients;
    case RCLC_ACTION_SERVER:
      return &info->number_of_action_servers;
    case RCLC_GUARD_CONDITION:
      return &info->number_of_guard_conditions;
    case RCLC_SERVICE:
    case RCLC_SERVICE_WITH_REQUEST_ID:
    case RCLC_SERVICE_WITH_CONTEXT:
    case RCLC_NONE:
    default:
      return &info->number_of_services;
  }
}

/* Removes a handle in use and returns it. */
static rclc_executor_handle_t nodes_extract(rclc_executor_t * executor, size_t at)
{
  rclc_executor_handle_t handle = executor->handles[at];

  --executor->index;
  for (size_t i = at; i < executor->index; ++i) {
    executor->handles[i] = executor->handles[i + 1u];
  }
  (void)rclc_executor_handle_init(&executor->handles[executor->index], executor->max_handles); /* not NULL */
  --*nodes_counter(&executor->info, handle.type);
  handle.data_available = false;
  handle.has_turn = false;
  return handle;
}

/* There is a free place. */
static void nodes_append(rclc_executor_t * executor, const rclc_executor_handle_t * handle)
{
  executor->handles[executor->index] = *handle;
  ++executor->index;
  ++*nodes_counter(&executor->info, handle->type);
}

/* Puts a handle behind the `group` handles that were put aside last. */
static void nodes_put_aside(rclc_executor_t * executor, const rclc_executor_handle_t * handle, size_t group)
{
  --executor->max_handles;
  for (size_t i = executor->max_handles; i < executor->max_handles + group; ++i) {
    executor->handles[i] = executor->handles[i + 1u];
  }
  executor->handles[executor->max_handles + group] = *handle;
}

static rcl_ret_t nodes_refuse(void)
{
  return microros_error_named(RCL_RET_ERROR, microros_error_executor, "it has no such handle of the node");
}

rcl_ret_t rclc_executor_remove_node(rclc_executor_t * executor, const rcl_node_t * node)
{
  const rcl_ret_t result = rclc_executor_nodes_check(executor, node);
  size_t group = 0;
  size_t at = 0;

  if (result != RCL_RET_OK) {
    return result;
  }
  while (at < executor->index) {
    if (rclc_executor_handle_is_of(&executor->handles[at], node)) {
      rclc_executor_handle_t handle = nodes_extract(executor, at);

      handle.node = node; /* its entity may be finalized meanwhile */
      nodes_put_aside(executor, &handle, group);
      ++group;
    } else {
      ++at;
    }
  }
  return group != 0u ? RCL_RET_OK : nodes_refuse();
}

/* Closes the gap of a handle that was put aside. */
static void nodes_take_back(rclc_executor_t * executor, size_t at)
{
  for (size_t i = at; i > executor->max_handles; --i) {
    executor->handles[i] = executor->handles[i - 1u];
  }
  (void)rclc_executor_handle_init(
    &executor->handles[executor->max_handles], MICROROS_HANDLES_MAX); /* not NULL */
  ++executor->max_handles;
}

/* Endpoints know their node; only the others need the assignment that they had. */
static const void * nodes_assigned(const rclc_executor_handle_t * handle)
{
  return handle->type == RCLC_TIMER || handle->type == RCLC_GUARD_CONDITION ? handle->node : NULL;
}

rcl_ret_t rclc_executor_add_node(rclc_executor_t * executor, const rcl_node_t * node)
{
  const rcl_ret_t result = rclc_executor_nodes_check(executor, node);
  bool any = false;

  if (result != RCL_RET_OK) {
    return result;
  }
  for (size_t at = executor->max_handles; at < MICROROS_HANDLES_MAX; ++at) {
    if (executor->handles[at].node == node) {
      rclc_executor_handle_t handle = executor->handles[at];

      handle.node = nodes_assigned(&handle);
      nodes_take_back(executor, at);
      nodes_append(executor, &handle);
      any = true;
    }
  }
  return any ? RCL_RET_OK : nodes_refuse();
}

rcl_ret_t rclc_executor_move_node(
  rclc_executor_t * executor, const rcl_node_t * node, rclc_executor_t * other)
{
  rclc_executor_node_info_t info = {0, 0};
  rcl_ret_t result = rclc_executor_nodes_check(other, node);
  size_t at = 0;

  if (result == RCL_RET_OK) {
    result = rclc_executor_query_node(executor, node, &info);
  }
  if (result != RCL_RET_OK) {
    return result;
  }
  if (info.running == 0u || executor == other) {
    return nodes_refuse();
  }
  if (info.running > other->max_handles - other->index) {
    const size_t used = MICROROS_HANDLES_MAX - (other->max_handles - other->index);

    microros_error_set(
      microros_error_of_pool(microros_error_pool_full, MICROROS_HANDLES_MAX), "handles", NULL,
      MICROROS_HANDLES_MAX, (uint32_t)(used + info.running));
    return RCL_RET_ERROR;
  }
  while (at < executor->index) {
    if (rclc_executor_handle_is_of(&executor->handles[at], node)) {
      const rclc_executor_handle_t handle = nodes_extract(executor, at);

      nodes_append(other, &handle);
    } else {
      ++at;
    }
  }
  return RCL_RET_OK;
}
