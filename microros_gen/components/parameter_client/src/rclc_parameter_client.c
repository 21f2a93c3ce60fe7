/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_client.h"

#include "microros/cdr.h"
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/lock.h"
#include "microros/rclc_parameter_client_hooks.h"
#include "microros/rmw_node.h"
#include "microros/text.h"
#include "rclc/client.h"

#include <string.h>

/* Values are copied from and to messages as they are. */
CDR_STATIC_ASSERT(rclc_parameter_client_assert_double_has_8_bytes, sizeof(double) == 8U);

enum { LONGEST_SERVICE = 28 }; /* bytes of the longest of rclc_parameter_client_services, with its NUL */

static rclc_parameter_client_t * parameter_client_first; /* of those that are open */

rclc_parameter_client_t * rclc_parameter_client_first(void)
{
  return parameter_client_first;
}

rcl_ret_t rclc_parameter_client_refuse(
  const rclc_parameter_client_t * client, rcl_ret_t result, const char * why)
{
  microros_error_set(microros_error_parameter_client, client->remote->name, why, 0, 0);
  return result;
}

rcl_ret_t rclc_parameter_client_refuse_limit(
  const rclc_parameter_client_t * client, const char * what, size_t found, size_t fits)
{
  microros_error_set(
    microros_error_parameter_client_limit, client->remote->name, what, (uint32_t)found, (uint32_t)fits);
  return RCLC_PARAMETER_CLIENT_LIMIT;
}

static void parameter_client_link(rclc_parameter_client_t * client)
{
  microros_lock();
  client->next = parameter_client_first;
  parameter_client_first = client;
  microros_unlock();
}

/* Closes the client; returns whether it was open. */
static bool parameter_client_unlink(const rclc_parameter_client_t * client)
{
  rclc_parameter_client_t ** link = &parameter_client_first;
  bool found;

  microros_lock();
  while (*link != NULL && *link != client) {
    link = &(*link)->next;
  }
  found = *link != NULL;
  if (found) {
    *link = client->next;
  }
  microros_unlock();
  return found;
}

static const rclc_parameter_client_remote_t * parameter_client_remote(
  const rcl_node_t * node, const char * name)
{
  const uint16_t index = rmw_node_index(node->impl);

  for (size_t i = 0; i < MICROROS_PARAMETER_CLIENTS; ++i) {
    const rclc_parameter_client_remote_t * remote = &rclc_parameter_client_remotes[i];

    if (remote->node == index && microros_text_equals(remote->name, name)) {
      return remote;
    }
  }
  return NULL;
}

static rcl_ret_t parameter_client_open(rclc_parameter_client_t * client)
{
  const size_t size = microros_text_size(client->remote->name);
  rcl_ret_t result = RCL_RET_OK;

  for (uint32_t i = 0; i < (uint32_t)RCLC_PARAMETER_CLIENT_CALLS && result == RCL_RET_OK; ++i) {
    const char * service = rclc_parameter_client_services[i];
    char name[MICROROS_PARAMETER_CLIENT_NODE_SIZE + LONGEST_SERVICE];

    if (service != NULL && (client->remote->calls >> i & 1u) != 0u) {
      (void)memcpy(name, client->remote->name, size);
      (void)memcpy(&name[size], service, microros_text_size(service) + 1u);
      result = rclc_client_init(
        &client->services[i], client->node, rclc_parameter_client_types[i], name,
        &rmw_qos_profile_parameters);
    }
  }
  return result;
}

static rcl_ret_t parameter_client_close(rclc_parameter_client_t * client, rcl_node_t * node)
{
  rcl_ret_t first = RCL_RET_OK;

  for (uint32_t i = 0; i < (uint32_t)RCLC_PARAMETER_CLIENT_CALLS; ++i) {
    const rcl_ret_t result = rcl_client_fini(&client->services[i], node);

    first = first == RCL_RET_OK ? result : first;
  }
  return first;
}

rcl_ret_t rclc_parameter_client_init_default(
  rclc_parameter_client_t * client, rcl_node_t * node, const char * remote)
{
  rcl_ret_t result;

  if (client == NULL || remote == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client or remote");
  }
  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (parameter_client_unlink(client)) {
    parameter_client_link(client);
    return rclc_parameter_client_refuse(
      client, RCL_RET_ALREADY_INIT, MICROROS_ERROR_WORDS("the client is open already"));
  }
  (void)memset(client, 0, sizeof(*client)); /* it may be uninitialized memory */
  client->node = node;
  client->call = (uint8_t)RCLC_PARAMETER_CLIENT_CALLS;
  client->remote = parameter_client_remote(node, remote);
  if (client->remote == NULL) {
    return microros_error_named(RCL_RET_ERROR, microros_error_parameter_client_undeclared, remote);
  }
  result = parameter_client_open(client);
  if (result == RCL_RET_OK) {
    parameter_client_link(client);
  } else {
    (void)parameter_client_close(client, node); /* the first error is reported */
  }
  return result;
}

rcl_ret_t rclc_parameter_client_fini(rclc_parameter_client_t * client, rcl_node_t * node)
{
  if (client == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client");
  }
  if (!rcl_node_is_valid_except_context(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (!parameter_client_unlink(client)) {
    return RCL_RET_OK;
  }
  client->is_busy = false;
  rclc_parameter_client_unwatch(client);
  return parameter_client_close(client, node);
}

static void parameter_client_note_round(const rclc_executor_t * executor, bool calls)
{
  microros_lock();
  for (rclc_parameter_client_t * client = parameter_client_first; client != NULL; client = client->next) {
    if (client->executor == executor) {
      client->is_calling = calls;
    }
  }
  microros_unlock();
}

void rclc_parameter_client_round_begins(const rclc_executor_t * executor)
{
  parameter_client_note_round(executor, true);
}

void rclc_parameter_client_round_ends(const rclc_executor_t * executor)
{
  parameter_client_note_round(executor, false);
}

size_t rclc_parameter_client_count(const rclc_parameter_client_t * client)
{
  return client != NULL && !client->is_busy && client->call < (uint8_t)RCLC_PARAMETER_CLIENT_CALLS
           ? client->count
           : 0u;
}

enum { PARAMETER_CLIENT_NS_PER_MS = 1000000 };

static rcl_ret_t parameter_client_look(
  const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  rclc_parameter_client_t * client = handle->callback_context;

  if (!rcl_client_is_valid(handle->client)) {
    return microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
  }
  *is_ready = rclc_parameter_client_is_due(client) || rclc_parameter_client_has_event(client);
  if (client->is_busy) {
    const int64_t left_ns = (int64_t)rclc_parameter_client_left_ms(client) * PARAMETER_CLIENT_NS_PER_MS;

    *look_again_ns = left_ns < *look_again_ns ? left_ns : *look_again_ns;
  }
  return RCL_RET_OK;
}

/* One event per round: its callback may finalize the client. */
static rcl_ret_t parameter_client_call(rclc_executor_handle_t * handle)
{
  rclc_parameter_client_t * client = handle->callback_context;
  rcl_ret_t result;

  if (rclc_parameter_client_is_due(client)) {
    if (rclc_parameter_client_is_done(client, &result)) {
      client->callback(client, result, client->context);
    }
  } else {
    rclc_parameter_client_take_event(client);
  }
  return RCL_RET_OK;
}

/* Without an executor an asynchronous call would never end: only the waiting forms are possible. */
static rcl_client_t * parameter_client_service(rclc_parameter_client_t * client)
{
  for (uint32_t i = 0; i < (uint32_t)RCLC_PARAMETER_CLIENT_CALLS; ++i) {
    if (rcl_client_is_valid(&client->services[i])) {
      return &client->services[i];
    }
  }
  return NULL;
}

rcl_ret_t rclc_executor_add_parameter_client(rclc_executor_t * executor, rclc_parameter_client_t * client)
{
  static const rclc_handle_kind_t kind = {
    parameter_client_look, rclc_handle_take_nothing, parameter_client_call};
  rclc_executor_handle_t * handle;

  if (executor == NULL || client == NULL || parameter_client_service(client) == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client or executor");
  }
  if (client->executor != NULL) {
    return rclc_parameter_client_refuse(
      client, RCL_RET_ERROR, MICROROS_ERROR_WORDS("an executor runs the client already"));
  }
  if (!rclc_parameter_client_may_watch(client, executor)) {
    return RCL_RET_ERROR;
  }
  handle = rclc_executor_add_handle(executor, RCLC_CLIENT, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->client = parameter_client_service(client);
  handle->callback_context = client;
  ++executor->info.number_of_clients;
  client->executor = executor;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_parameter_client(rclc_executor_t * executor, rclc_parameter_client_t * client)
{
  rcl_ret_t result;

  if (client == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client");
  }
  result = rclc_executor_remove_client(executor, parameter_client_service(client));
  if (result == RCL_RET_OK) {
    client->executor = NULL;
    client->is_calling = false;
  }
  return result;
}
