/* SPDX-License-Identifier: Apache-2.0 */
/* The services of a life cycle that the executor serves. */
#include "microros/cdr_decode.h"
#include "microros/error.h"
#include "microros/rcl_lifecycle_states.h"
#include "microros/rclc_lifecycle_change.h"
#include "microros/service_type.h"
#include "rclc/service.h"

#include <stddef.h>
#include <string.h>

/*
 * A request to change the state is answered whatever it contains: its own decoder takes a label that is too long
 * for one that no transition has. No label of ROS 2 begins with a space.
 */
static const char change_unknown[] = " ";

/* Where the label begins, after its length. Of a request that is too large only the id and its padding arrive. */
enum { CHANGE_BEGINNING = 4, CHANGE_LABEL_AT = CHANGE_BEGINNING + 4 };

/* Returns the length of the label, with its NUL; 0 if the body ends before it. */
static uint32_t change_length(const cdr_in_t * in)
{
  uint32_t length = 0;

  if (in->size >= (uint32_t)CHANGE_LABEL_AT) {
    (void)memcpy(&length, &in->body[CHANGE_BEGINNING], sizeof(length));
  }
  return in->swap ? length >> 24 | (length >> 8 & 0xff00u) | (length << 8 & 0xff0000u) | length << 24
                  : length;
}

static void change_decode(cdr_in_t * in, void * message)
{
  lifecycle_msgs__srv__ChangeState_Request * request = message;
  rosidl_runtime_c__String * label = &request->transition.label;
  const bool is_beginning = in->size == (uint32_t)CHANGE_BEGINNING;
  uint32_t length = change_length(in);
  const void * from = change_unknown;

  if (
    !is_beginning &&
    (in->size < (uint32_t)CHANGE_LABEL_AT || length > in->size - (uint32_t)CHANGE_LABEL_AT)) {
    cdr_in_refuse(in, CDR_FAULT_END, "label", (uint64_t)length + CHANGE_LABEL_AT, in->size);
    return;
  }
  if (is_beginning || length > label->capacity) {
    length = sizeof(change_unknown);
  } else {
    from = &in->body[CHANGE_LABEL_AT];
  }
  request->transition.id = in->body[0];
  label->size = length == 0u ? 0u : (size_t)length - 1u;
  (void)memcpy(label->data, from, (size_t)length);
  label->data[label->size] = '\0';
}

static uint32_t change_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const lifecycle_msgs__srv__ChangeState_Response * response = message;

  (void)fault;
  body[0] = response->success ? 1u : 0u;
  return 1u;
}

static const microros_message_type_t change_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("lifecycle_msgs::srv::dds_::ChangeState_Request_"),
  .max_encoded_size = lifecycle_msgs__srv__ChangeState_Request__MAX_ENCODED_SIZE,
  .decode = change_decode};
static const microros_message_type_t change_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("lifecycle_msgs::srv::dds_::ChangeState_Response_"),
  .max_encoded_size = lifecycle_msgs__srv__ChangeState_Response__MAX_ENCODED_SIZE,
  .encode = change_encode};
static const microros_service_type_t change_service = {
  .dds_type_name = MICROROS_FLASH_NAME("lifecycle_msgs::srv::dds_::ChangeState_"),
  .request = &change_request,
  .response = &change_response};
const rosidl_service_type_support_t rclc_lifecycle_change_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &change_service};

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
