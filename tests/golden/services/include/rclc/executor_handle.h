/* SPDX-License-Identifier: Apache-2.0 */
/* The executor's record of an entity; trigger functions read it. */
#ifndef MICROROS_RCLC_EXECUTOR_HANDLE_H
#define MICROROS_RCLC_EXECUTOR_HANDLE_H

#include <stdbool.h>
#include <stddef.h>

#include "rcl/guard_condition.h"
#include "rcl/types.h"
#include "rcl/wait.h"
#include "rclc/visibility_control.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  RCLC_SUBSCRIPTION,
  RCLC_SUBSCRIPTION_WITH_CONTEXT,
  RCLC_TIMER,
  RCLC_CLIENT,
  RCLC_CLIENT_WITH_REQUEST_ID,
  RCLC_SERVICE,
  RCLC_SERVICE_WITH_REQUEST_ID,
  RCLC_SERVICE_WITH_CONTEXT,
  RCLC_ACTION_CLIENT,
  RCLC_ACTION_SERVER,
  RCLC_GUARD_CONDITION,
  RCLC_NONE
} rclc_executor_handle_type_t;

/* When to call the callback in a round: on new data, or always; it gets NULL if there is no message. */
typedef enum { ON_NEW_DATA, ALWAYS } rclc_executor_handle_invocation_t;

typedef void (*rclc_subscription_callback_t)(const void * message);
typedef rclc_subscription_callback_t rclc_callback_t;
typedef void (*rclc_subscription_callback_with_context_t)(const void * message, void * context);
typedef void (*rclc_service_callback_t)(const void * request, void * response);
typedef void (*rclc_service_callback_with_request_id_t)(
  const void * request, rmw_request_id_t * request_id, void * response);
typedef void (*rclc_service_callback_with_context_t)(const void * request, void * response, void * context);
typedef void (*rclc_client_callback_t)(const void * response);
typedef void (*rclc_client_callback_with_request_id_t)(const void * response, rmw_request_id_t * request_id);
typedef void (*rclc_gc_callback_t)(void);

struct rclc_handle_kind_s; /* microros/executor_handles.h */

/* `type` says which pointer is set; members of components that are not selected do not exist. */
typedef struct {
  rclc_executor_handle_type_t type;
  rclc_executor_handle_invocation_t invocation;
  rcl_client_t * client;
  rcl_service_t * service;
  rcl_guard_condition_t * gc;
  const struct rclc_handle_kind_s * kind;
  union {
    rclc_gc_callback_t gc;
    rclc_service_callback_t service;
    rclc_service_callback_with_request_id_t service_with_request_id;
    rclc_service_callback_with_context_t service_with_context;
    rclc_client_callback_t client;
    rclc_client_callback_with_request_id_t client_with_request_id;
  } callback;
  void * data; /* the message to decode into */
  void * callback_context;
  rmw_request_id_t req_id;
  void * data_response_msg;
  size_t index;
  bool initialized;
  bool data_available; /* the callback is due */
  bool has_turn;       /* in the current round */
} rclc_executor_handle_t;

typedef struct {
  size_t number_of_subscriptions;
  size_t number_of_timers;
  size_t number_of_clients;
  size_t number_of_services;
  size_t number_of_action_clients;
  size_t number_of_action_servers;
  size_t number_of_guard_conditions;
  size_t number_of_events;
} rclc_executor_handle_counters_t;

rcl_ret_t rclc_executor_handle_counters_zero_init(rclc_executor_handle_counters_t * handle_counters);

/* Initializes an unused handle with index `max_handles`. */
rcl_ret_t rclc_executor_handle_init(rclc_executor_handle_t * handle, size_t max_handles);

rcl_ret_t rclc_executor_handle_clear(rclc_executor_handle_t * handle, size_t max_handles);

/* Prints nothing: the library has no output. */
rcl_ret_t rclc_executor_handle_print(rclc_executor_handle_t * handle);

/* Returns the entity (rcl_subscription_t *, rcl_timer_t *, …); NULL for an unused handle. */
void * rclc_executor_handle_get_ptr(rclc_executor_handle_t * handle);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_EXECUTOR_HANDLE_H */
