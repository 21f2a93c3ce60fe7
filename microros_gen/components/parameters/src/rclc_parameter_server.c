/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/rclc_parameters.h"
#include "microros/rmw_by_place.h"
#include "microros/rmw_parameters.h"
#include "microros/rmw_service.h"
#if MICROROS_PARAMETERS_HELD
#include "microros/rclc_parameter_held.h"
#endif
#include "rcl/publisher.h"

#include <stddef.h>
#include <string.h>

/* As in rmw_qos_profile_parameters and rmw_qos_profile_parameter_events. */
enum { SERVER_DEPTH = 1000 };

typedef struct server_service_t {
  const rosidl_service_type_support_t * type;
  rclc_service_callback_with_context_t callback;
} server_service_t;

#if MICROROS_PARAMETERS_HELD
static const server_service_t server_offers[RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES] = {
  {&rclc_parameter_exchange_type, rclc_parameter_exchange},
};
#else
/* Replies are written from the store, by the encoders of their types. */
static void server_reply(const void * request, void * response, void * context)
{
  (void)request;
  (void)response;
  (void)context;
}

static void server_set_each(const void * request, void * response, void * context)
{
  (void)request;
  (void)response;
  rclc_parameter_set_each(context);
}

static void server_set_all(const void * request, void * response, void * context)
{
  (void)request;
  (void)response;
  rclc_parameter_set_all(context);
}

static const server_service_t server_offers[RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES] = {
  {&rclc_parameter_describe_type, server_reply}, {&rclc_parameter_get_types_type, server_reply},
  {&rclc_parameter_get_type, server_reply},      {&rclc_parameter_list_type, server_reply},
  {&rclc_parameter_set_type, server_set_each},   {&rclc_parameter_set_atomically_type, server_set_all},
};
#endif

/* The plan has the places of the services and of the publisher, in this order: none is looked for by its name. */
static rcl_ret_t server_open(rclc_parameter_server_t * server, const rcl_node_t * node)
{
  uint16_t at = 0;

  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  for (uint32_t i = 0; i < (uint32_t)RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES; ++i) {
    const rcl_ret_t result = rmw_replier_open_by_place(
      node->impl, server_offers[i].type, (uint16_t)SERVER_DEPTH, &at, &server->services[i].impl);

    if (result != RCL_RET_OK) {
      return result;
    }
#if !MICROROS_PARAMETERS_HELD
    rmw_parameters_answer_large(server->services[i].impl, (uint8_t)RMW_PARAMETERS_BEGINNING);
#endif
  }
#if MICROROS_PARAMETERS_HELD
  return rclc_parameter_held_open(server, node);
#else
  if (!server->notify_changed_over_dds) {
    return RCL_RET_OK;
  }
  return rmw_publisher_open_by_place(
    node->impl, &rclc_parameter_event_type, (uint16_t)SERVER_DEPTH, &server->event_publisher.impl);
#endif
}

/* Closes all services and the publisher, as far as they are open. Returns the first error. */
static rcl_ret_t server_close(rclc_parameter_server_t * server, rcl_node_t * node)
{
  rcl_ret_t first = RCL_RET_OK;

  for (uint32_t i = 0; i < (uint32_t)RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES; ++i) {
    rcl_ret_t result;

#if !MICROROS_PARAMETERS_HELD
    if (rcl_service_is_valid(&server->services[i])) {
      rmw_parameters_answer_large(rcl_service_get_rmw_handle(&server->services[i]), 0u);
    }
#endif
    result = rcl_service_fini(&server->services[i], node);
    first = first == RCL_RET_OK ? result : first;
  }
  if (rcl_publisher_is_valid(&server->event_publisher)) {
    const rcl_ret_t result = rcl_publisher_fini(&server->event_publisher, node);

    first = first == RCL_RET_OK ? result : first;
  }
  return first;
}

static rcl_ret_t server_init(
  rclc_parameter_server_t * parameter_server, rcl_node_t * node, const rclc_parameter_options_t * options)
{
  rcl_ret_t result;

  if (parameter_server == NULL || node == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "parameter_server or node");
  }
  /* It may be uninitialized memory. What follows the places is written before it is read, as each place is. */
  (void)memset(parameter_server, 0, offsetof(rclc_parameter_server_t, places));
  parameter_server->node = node;
  parameter_server->max_params = options->max_params;
  parameter_server->notify_changed_over_dds = options->notify_changed_over_dds;
  parameter_server->low_mem_mode = options->low_mem_mode;
  result = server_open(parameter_server, node);
  if (result != RCL_RET_OK) {
    (void)server_close(parameter_server, node); /* the first error is reported */
    parameter_server->node = NULL;
  }
  return result;
}

rcl_ret_t rclc_parameter_server_init_default(rclc_parameter_server_t * parameter_server, rcl_node_t * node)
{
  static const rclc_parameter_options_t options = {
    .notify_changed_over_dds = true,
    .max_params = MICROROS_PARAMETERS_MAX,
    .allow_undeclared_parameters = false,
    .low_mem_mode = false};

  return server_init(parameter_server, node, &options);
}

rcl_ret_t rclc_parameter_server_init_with_option(
  rclc_parameter_server_t * parameter_server, rcl_node_t * node, const rclc_parameter_options_t * options)
{
  rcl_ret_t result;

  if (options == NULL || options->max_params == 0u) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "options or max_params");
  }
  if (options->max_params > MICROROS_PARAMETERS_MAX) {
    microros_error_set(
      microros_error_parameters_full, rcl_node_get_name(node), NULL, MICROROS_PARAMETERS_MAX,
      (uint32_t)options->max_params);
    return RCL_RET_INVALID_ARGUMENT;
  }
  result = server_init(parameter_server, node, options);
  if (result == RCL_RET_OK && options->allow_undeclared_parameters) {
    parameter_server->undeclared = &rclc_parameter_undeclared;
  }
  return result;
}

/* Without its node it is not initialized: what it would save now is no parameter, instead of those that were saved. */
rcl_ret_t rclc_parameter_server_fini(rclc_parameter_server_t * parameter_server, rcl_node_t * node)
{
  if (parameter_server == NULL || node == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "parameter_server or node");
  }
  parameter_server->node = NULL;
  parameter_server->count = 0;
  parameter_server->on_modification = NULL;
  if (parameter_server->own != NULL) {
    parameter_server->own->server = NULL;
    parameter_server->own = NULL;
  }
  return server_close(parameter_server, node);
}

static rclc_handle_kind_t server_kind; /* that of a service, which also publishes due events */

/*
 * As for a service. Its function is not called here: the call through a pointer would look like a recursion. The task of the
 * session looks once at each handle of the others while it holds the lock; one of those that a server takes is this one's.
 */
/* at most MICROROS_HANDLES_MAX / (6 - 5 * MICROROS_PARAMETERS_HELD) * (MICROROS_TASKS - 1) calls in a hold */
static rcl_ret_t server_look(const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  if (!rcl_service_is_valid(handle->service)) {
    return microros_error_refuse(RCL_RET_SERVICE_INVALID, "service");
  }
  rclc_parameter_publish(handle->callback_context);
#if MICROROS_PARAMETERS_HELD
  rclc_parameter_held_look(handle->callback_context, look_again_ns);
#else
  (void)look_again_ns;
#endif
  *is_ready = rmw_replier_is_ready(handle->service->impl);
  return RCL_RET_OK;
}

/* Lets the executor retry events without room, whenever it checks the handle that was added last. */
static void server_watch(rclc_executor_t * executor)
{
  rclc_executor_handle_t * handle = &executor->handles[executor->index - 1u];

  server_kind = *handle->kind;
  server_kind.look = server_look;
  handle->kind = &server_kind;
}

rcl_ret_t rclc_executor_add_parameter_server_with_context(
  rclc_executor_t * executor, rclc_parameter_server_t * parameter_server,
  rclc_parameter_callback_t on_modification, void * context)
{
  rcl_ret_t result = RCL_RET_OK;

  if (executor == NULL || parameter_server == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "parameter_server or executor");
  }
  parameter_server->on_modification = on_modification;
  parameter_server->context = context;
  for (uint32_t i = 0; i < (uint32_t)RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES && result == RCL_RET_OK; ++i) {
    result = rclc_executor_add_service_with_context(
      executor, &parameter_server->services[i], parameter_server, parameter_server, server_offers[i].callback,
      parameter_server);
  }
  if (result == RCL_RET_OK) {
    server_watch(executor);
#if MICROROS_PARAMETERS_HELD
    rclc_parameter_held_begin(parameter_server);
#endif
  }
  return result;
}

rcl_ret_t rclc_executor_add_parameter_server(
  rclc_executor_t * executor, rclc_parameter_server_t * parameter_server,
  rclc_parameter_callback_t on_modification)
{
  return rclc_executor_add_parameter_server_with_context(executor, parameter_server, on_modification, NULL);
}
