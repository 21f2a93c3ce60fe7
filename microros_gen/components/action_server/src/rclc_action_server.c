/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/action_server.h"

#include "action_msgs/msg/goal_status_array.h"
#include "action_msgs/srv/cancel_goal.h"
#include "microros/action_name.h"
#include "microros/action_type.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/plan.h"
#include "microros/rcl_names_take.h"
#include "microros/rclc_action_server.h"
#include "microros/rmw_action_server.h"
#include "microros/rmw_client.h"
#include "microros/rmw_names.h"
#include "microros/rmw_node.h"
#include "microros/text.h"

#include <string.h>

static const char * action_endpoint(uint16_t at)
{
  return microros_declared_name(&microros_declared_endpoints[at]);
}

const char * rclc_action_name(const rclc_action_server_t * server)
{
  return server->rcl_handle.goal_service.impl->service_name;
}

static const rclc_action_declared_t * action_find(
  const rcl_node_t * node, const rmw_name_t * name, const microros_action_type_t * type)
{
  for (size_t i = 0; i < MICROROS_ACTION_SERVERS; ++i) {
    const rclc_action_declared_t * declared = &rclc_action_declared[i];

    if (
      declared->node == rmw_node_index(node->impl) &&
      rcl_action_is_named(action_endpoint(declared->goal_at), name) &&
      microros_text_equals(microros_declared_endpoints[declared->goal_at].dds_type, type->send_goal)) {
      return declared;
    }
  }
  return NULL;
}

static rcl_ret_t action_open_services(rclc_action_server_t * server, const rcl_node_t * node)
{
  const rclc_action_declared_t * declared = server->declared;
  const rcl_service_options_t options = rcl_service_get_default_options();
  rcl_ret_t result = rcl_service_init(
    &server->rcl_handle.goal_service, node, &declared->goal_type, action_endpoint(declared->goal_at),
    &options);

  if (result == RCL_RET_OK) {
    result = rcl_service_init(
      &server->rcl_handle.cancel_service, node, ROSIDL_GET_SRV_TYPE_SUPPORT(action_msgs, srv, CancelGoal),
      action_endpoint(declared->cancel_at), &options);
  }
  if (result == RCL_RET_OK) {
    result = rcl_service_init(
      &server->rcl_handle.result_service, node, &declared->result_type, action_endpoint(declared->result_at),
      &options);
  }
  return result;
}

static rcl_ret_t action_open_publishers(rclc_action_server_t * server, const rcl_node_t * node)
{
  const rclc_action_declared_t * declared = server->declared;
  const microros_action_type_t * type = server->type;
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  rcl_ret_t result = rcl_publisher_init(
    &server->rcl_handle.feedback_publisher, node, type->feedback, action_endpoint(declared->feedback_at),
    &options);

  if (result == RCL_RET_OK) {
    options.qos = rcl_action_qos_profile_status_default;
    result = rcl_publisher_init(
      &server->rcl_handle.status_publisher, node,
      ROSIDL_GET_MSG_TYPE_SUPPORT(action_msgs, msg, GoalStatusArray), action_endpoint(declared->status_at),
      &options);
  }
  return result;
}

/* Closes what is open; returns the first error. */
static rcl_ret_t action_close(rclc_action_server_t * server, rcl_node_t * node)
{
  const rcl_ret_t results[] = {
    rcl_publisher_fini(&server->rcl_handle.status_publisher, node),
    rcl_publisher_fini(&server->rcl_handle.feedback_publisher, node),
    rcl_service_fini(&server->rcl_handle.result_service, node),
    rcl_service_fini(&server->rcl_handle.cancel_service, node),
    rcl_service_fini(&server->rcl_handle.goal_service, node)};
  rcl_ret_t first = RCL_RET_OK;

  for (size_t i = 0; i < sizeof(results) / sizeof(results[0]); ++i) {
    first = first == RCL_RET_OK ? results[i] : first;
  }
  microros_lock();
  for (size_t i = 0; i < server->declared->goals_max; ++i) {
    if (server->declared->goals[i].action_server == server) { /* not those of a server that was open before */
      server->declared->goals[i].is_used = false;
      server->declared->goals[i].action_server = NULL;
    }
  }
  server->declared = NULL;
  server->goal_handles_memory_size = 0u;
  microros_unlock();
  return first;
}

static rcl_ret_t action_open(rclc_action_server_t * server, rcl_node_t * node)
{
  rcl_ret_t result = action_open_services(server, node);

  if (result == RCL_RET_OK) {
    result = action_open_publishers(server, node);
  }
  if (result != RCL_RET_OK) {
    (void)action_close(server, node); /* the first error is the one to report */
    return result;
  }
  rmw_action_server_answer_large(server->rcl_handle.goal_service.impl);
  server->session = (uint8_t)rmw_client_reconnects();
  server->status_due = true;
  return RCL_RET_OK;
}

/* `node` and `type_support` are valid. */
static rcl_ret_t action_declared(
  rclc_action_server_t * server, const rcl_node_t * node, const rosidl_action_type_support_t * type_support,
  const char * action_name)
{
  const microros_action_type_t * type = type_support->data;
  rcl_names_topic_t taken;
  rmw_name_t name;
  const char * fault = rcl_names_take(&taken, action_name, node->impl);

  if (fault != NULL) {
    microros_error_set(microros_error_name, action_name, fault, 0, 0);
    return RCL_RET_ACTION_NAME_INVALID;
  }
  name = rmw_name_of_topic(taken.name, node->impl->name, node->impl->namespace_);
  server->type = type;
  server->declared = action_find(node, &name, type);
  if (server->declared == NULL) {
    microros_error_set(microros_error_action_server_undeclared, action_name, type->dds_type_name, 0, 0);
    return RCL_RET_ERROR;
  }
  return RCL_RET_OK;
}

rcl_ret_t rclc_action_server_init_default(
  rclc_action_server_t * action_server, rcl_node_t * node, rclc_support_t * support,
  const rosidl_action_type_support_t * type_support, const char * action_name)
{
  rcl_ret_t result;

  if (action_server == NULL || support == NULL || type_support == NULL || action_name == NULL) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "action_server, support, type_support or action_name");
  }
  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  (void)memset(action_server, 0, sizeof(*action_server)); /* it may be uninitialized memory */
  result = action_declared(action_server, node, type_support, action_name);
  return result == RCL_RET_OK ? action_open(action_server, node) : result;
}

rcl_ret_t rclc_action_server_fini(rclc_action_server_t * action_server, rcl_node_t * node)
{
  if (action_server == NULL || action_server->declared == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "action_server");
  }
  if (!rcl_node_is_valid_except_context(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  return action_close(action_server, node);
}
