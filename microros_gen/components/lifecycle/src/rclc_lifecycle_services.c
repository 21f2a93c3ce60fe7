/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_lifecycle_states.h"
#include "microros/rclc_lifecycle_change.h"
#include "rclc/service.h"

#include <stddef.h>

/* Adds the service that the callback serves. */
static rcl_ret_t services_add(
  rclc_lifecycle_service_context_t * context, rclc_executor_t * executor,
  rclc_service_callback_with_context_t callback)
{
  rclc_lifecycle_node_t * node = context != NULL ? context->lifecycle_node : NULL;
  rcl_lifecycle_com_interface_t * offers;
  rcl_service_t * service;
  void * request;
  void * response;

  if (node == NULL || node->state_machine == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "context");
  }
  offers = &node->state_machine->com_interface;
  service = &offers->srv_change_state;
  request = &node->cs_req;
  response = &node->cs_res;
  if (callback == rclc_lifecycle_get_state_callback) {
    service = &offers->srv_get_state;
    request = &node->gs_req;
    response = &node->gs_res;
  } else if (callback == rclc_lifecycle_get_available_states_callback) {
    service = &offers->srv_get_available_states;
    request = &node->gas_req;
    response = &node->gas_res;
  }
  return rclc_executor_add_service_with_context(executor, service, request, response, callback, context);
}

rcl_ret_t rclc_lifecycle_init_get_state_server(
  rclc_lifecycle_service_context_t * context, rclc_executor_t * executor)
{
  return services_add(context, executor, rclc_lifecycle_get_state_callback);
}

rcl_ret_t rclc_lifecycle_init_get_available_states_server(
  rclc_lifecycle_service_context_t * context, rclc_executor_t * executor)
{
  return services_add(context, executor, rclc_lifecycle_get_available_states_callback);
}

rcl_ret_t rclc_lifecycle_init_change_state_server(
  rclc_lifecycle_service_context_t * context, rclc_executor_t * executor)
{
  return services_add(context, executor, rclc_lifecycle_change_state_callback);
}

void rclc_lifecycle_get_state_callback(const void * req, void * res, void * context)
{
  const rclc_lifecycle_service_context_t * service = context;
  lifecycle_msgs__srv__GetState_Response * response = res;

  (void)req;
  response->current_state = rcl_lifecycle_message_of(service->lifecycle_node->state_machine->current_state);
}

void rclc_lifecycle_get_available_states_callback(const void * req, void * res, void * context)
{
  static lifecycle_msgs__msg__State states[RCL_LIFECYCLE_STATES]; /* their texts are constants */
  lifecycle_msgs__srv__GetAvailableStates_Response * response = res;

  (void)req;
  (void)context;
  for (size_t i = 0; i < RCL_LIFECYCLE_STATES; ++i) {
    states[i] = rcl_lifecycle_message_of(&rcl_lifecycle_states[i]);
  }
  response->available_states.data = states;
  response->available_states.size = RCL_LIFECYCLE_STATES;
  response->available_states.capacity = RCL_LIFECYCLE_STATES;
}

/* Returns the requested transition; -1: its label is none of those of the current state. */
static int32_t services_requested(
  const lifecycle_msgs__srv__ChangeState_Request * request, const rcl_lifecycle_state_t * state)
{
  const rcl_lifecycle_transition_t * transition;

  if (request->transition.label.size == 0u) {
    return request->transition.id;
  }
  transition = rcl_lifecycle_get_transition_by_label(state, request->transition.label.data);
  return transition == NULL ? -1 : (int32_t)transition->id;
}

void rclc_lifecycle_change_state_callback(const void * req, void * res, void * context)
{
  const rclc_lifecycle_service_context_t * service = context;
  rclc_lifecycle_node_t * node = service->lifecycle_node;
  lifecycle_msgs__srv__ChangeState_Response * response = res;
  const int32_t id = services_requested(req, node->state_machine->current_state);

  response->success = id >= 0 && rclc_lifecycle_change(node, (unsigned int)id, true) == LIFECYCLE_SUCCESS;
}
