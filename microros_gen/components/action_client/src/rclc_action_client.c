/* SPDX-License-Identifier: Apache-2.0 */
/* Opens and closes clients of actions. */
#include "action_msgs/srv/cancel_goal.h"
#include "microros/action_name.h"
#include "microros/action_type.h"
#include "microros/cdr.h"
#include "microros/cdr_decode.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/plan.h"
#include "microros/rcl_names_take.h"
#include "microros/rclc_action_client.h"
#include "microros/rmw_action_client.h"
#include "microros/rmw_client.h"
#include "microros/rmw_names.h"
#include "microros/rmw_node.h"
#include "microros/text.h"
#include "rclc/action_client.h"

#include <string.h>

/* The members of a response: accepted, then the time at which it was, which nothing here needs. */
enum { CLIENT_RESPONSE_SIZE = 12 };

static void client_decode_response(cdr_in_t * in, void * accepted)
{
  cdr_get_bool(in, accepted, 1, "accepted");
}

static uint32_t client_encode_id(const void * uuid, uint8_t * body, cdr_fault_t * fault)
{
  (void)fault;
  (void)memcpy(body, uuid, UUID_SIZE);
  return UUID_SIZE;
}

/* The response to a goal request, the same for all actions. Its message: bool, whether accepted. */
static const microros_message_type_t client_response_type = {
  .dds_type_name = MICROROS_ERROR_TYPE("SendGoal_Response_"),
  .max_encoded_size = CLIENT_RESPONSE_SIZE,
  .decode = client_decode_response};

/* The request for a result, whose message is the id; the same for all actions. */
static const microros_message_type_t client_id_type = {
  .dds_type_name = MICROROS_ERROR_TYPE("GetResult_Request_"),
  .max_encoded_size = UUID_SIZE,
  .encode = client_encode_id};

static const char * client_endpoint(uint16_t at)
{
  return microros_declared_name(&microros_declared_endpoints[at]);
}

const char * rclc_action_client_name(const rclc_action_client_t * client)
{
  return client_endpoint(client->declared->goal_at);
}

static const rclc_action_client_declared_t * client_find(
  const rcl_node_t * node, const rmw_name_t * name, const microros_action_type_t * type)
{
  for (size_t i = 0; i < MICROROS_ACTION_CLIENTS; ++i) {
    const rclc_action_client_declared_t * declared = &rclc_action_client_declared[i];

    if (
      declared->node == rmw_node_index(node->impl) &&
      rcl_action_is_named(client_endpoint(declared->goal_at), name) &&
      microros_text_equals(microros_declared_endpoints[declared->goal_at].dds_type, type->send_goal)) {
      return declared;
    }
  }
  return NULL;
}

static rcl_ret_t client_open_clients(rclc_action_client_t * client, const rcl_node_t * node)
{
  const rclc_action_client_declared_t * declared = client->declared;
  const rcl_client_options_t options = rcl_client_get_default_options();
  const rosidl_service_type_support_t goal = {MICROROS_TYPE_SUPPORT_IDENTIFIER, &client->goal_type};
  const rosidl_service_type_support_t outcome = {MICROROS_TYPE_SUPPORT_IDENTIFIER, &client->result_type};
  rcl_action_client_t * opened = &client->rcl_handle;
  rcl_ret_t result =
    rcl_client_init(&opened->goal_client, node, &goal, client_endpoint(declared->goal_at), &options);

  if (result == RCL_RET_OK) {
    result = rcl_client_init(
      &opened->cancel_client, node, ROSIDL_GET_SRV_TYPE_SUPPORT(action_msgs, srv, CancelGoal),
      client_endpoint(declared->cancel_at), &options);
  }
  if (result == RCL_RET_OK) {
    result =
      rcl_client_init(&opened->result_client, node, &outcome, client_endpoint(declared->result_at), &options);
  }
  return result;
}

/* Closes what is open; returns the first error. */
static rcl_ret_t client_close(rclc_action_client_t * client, rcl_node_t * node)
{
  rcl_action_client_t * opened = &client->rcl_handle;
  const rcl_ret_t results[] = {
    rcl_subscription_fini(&opened->feedback_subscription, node),
    rcl_client_fini(&opened->result_client, node), rcl_client_fini(&opened->cancel_client, node),
    rcl_client_fini(&opened->goal_client, node)};
  rcl_ret_t first = RCL_RET_OK;

  for (size_t i = 0; i < sizeof(results) / sizeof(results[0]); ++i) {
    first = first == RCL_RET_OK ? results[i] : first;
  }
  microros_lock();
  for (size_t i = 0; i < client->declared->goals_max; ++i) {
    if (client->declared->goals[i].action_client == client) { /* not those of a client that was open before */
      client->declared->goals[i].is_used = false;
      client->declared->goals[i].action_client = NULL;
    }
  }
  client->declared = NULL;
  client->goal_handles_memory_size = 0u;
  microros_unlock();
  return first;
}

static rcl_ret_t client_open(
  rclc_action_client_t * client, rcl_node_t * node, const microros_action_type_t * type)
{
  const rcl_subscription_options_t options = rcl_subscription_get_default_options();
  rcl_ret_t result;

  client->goal_type.dds_type_name = type->send_goal;
  client->goal_type.request = type->goal_request->data;
  client->goal_type.response = &client_response_type;
  client->result_type.dds_type_name = type->get_result;
  client->result_type.request = &client_id_type;
  client->result_type.response = type->result_response->data;
  result = client_open_clients(client, node);
  if (result == RCL_RET_OK) {
    result = rcl_subscription_init(
      &client->rcl_handle.feedback_subscription, node, type->feedback,
      client_endpoint(client->declared->feedback_at), &options);
  }
  if (result != RCL_RET_OK) {
    (void)client_close(client, node); /* the first error is the one to report */
    return result;
  }
  client->session = (uint8_t)rmw_client_reconnects();
  client->drops = rmw_action_client_drops(client->rcl_handle.goal_client.impl);
  return RCL_RET_OK;
}

rcl_ret_t rclc_action_client_init_default(
  rclc_action_client_t * action_client, rcl_node_t * node, const rosidl_action_type_support_t * type_support,
  const char * action_name)
{
  const microros_action_type_t * type;
  rcl_names_topic_t taken;
  rmw_name_t name;
  const char * fault;

  if (action_client == NULL || type_support == NULL || action_name == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "action_client, type_support or action_name");
  }
  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  (void)memset(action_client, 0, sizeof(*action_client)); /* it may be uninitialized memory */
  type = type_support->data;
  fault = rcl_names_take(&taken, action_name, node->impl);
  if (fault != NULL) {
    microros_error_set(microros_error_name, action_name, fault, 0, 0);
    return RCL_RET_ACTION_NAME_INVALID;
  }
  name = rmw_name_of_topic(taken.name, node->impl->name, node->impl->namespace_);
  action_client->declared = client_find(node, &name, type);
  if (action_client->declared == NULL) {
    microros_error_set(microros_error_action_client_undeclared, action_name, type->dds_type_name, 0, 0);
    return RCL_RET_ERROR;
  }
  return client_open(action_client, node, type);
}

rcl_ret_t rclc_action_client_fini(rclc_action_client_t * action_client, rcl_node_t * node)
{
  if (action_client == NULL || action_client->declared == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "action_client");
  }
  if (!rcl_node_is_valid_except_context(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  return client_close(action_client, node);
}
