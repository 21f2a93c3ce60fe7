/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages of a life cycle, written from the constants: what has no room in a slot is written in fragments, and no text is
 * copied before. On the wire the name of a service is enough; the names of its messages occur only in error texts.
 */
#include "microros/rcl_lifecycle_types.h"

#include "lifecycle_msgs/msg/transition_event.h"
#include "lifecycle_msgs/srv/get_available_states.h"
#include "lifecycle_msgs/srv/get_available_transitions.h"
#include "lifecycle_msgs/srv/get_state.h"
#include "microros/cdr_decode.h"
#include "microros/error.h"
#include "microros/rcl_lifecycle_states.h"
#include "microros/service_type.h"
#include "microros/text.h"

enum { EVENT_TIME_SIZE = 8 };

/* A part of a body: its bytes from `from` on, at most `size`, go to `to`. */
typedef struct types_out_t {
  uint8_t * to;
  uint32_t from;
  uint32_t size;
  uint32_t position; /* in the whole body */
} types_out_t;

static void types_put(types_out_t * out, uint8_t byte)
{
  const uint32_t at = out->position - out->from; /* wraps to a large number before `from` */

  if (at < out->size) {
    out->to[at] = byte;
  }
  ++out->position;
}

static void types_put_4(types_out_t * out, uint32_t number)
{
  while (out->position % 4u != 0u) {
    types_put(out, 0u);
  }
  for (uint32_t shift = 0; shift < 32u; shift += 8u) {
    types_put(out, (uint8_t)(number >> shift & 0xffu));
  }
}

/* Writes an id and a label: a lifecycle_msgs/msg/State or lifecycle_msgs/msg/Transition. */
static void types_put_named(types_out_t * out, uint8_t id, const char * label)
{
  const size_t size = microros_text_size(label) + 1u;

  types_put(out, id);
  types_put_4(out, (uint32_t)size);
  for (size_t i = 0; i < size; ++i) {
    types_put(out, (uint8_t)label[i]);
  }
}

static void types_put_transition(types_out_t * out, const rcl_lifecycle_transition_t * transition)
{
  types_put_named(out, (uint8_t)transition->id, transition->label);
  types_put_named(out, transition->start->id, transition->start->label);
  types_put_named(out, transition->goal->id, transition->goal->label);
}

static void types_put_state(types_out_t * out, const lifecycle_msgs__msg__State * state)
{
  types_put_named(out, state->id, state->label.data != NULL ? state->label.data : "");
}

/* The message is a state machine's state. */
static uint32_t types_encode_transitions(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rcl_lifecycle_state_t * state = message;
  types_out_t out = {body, 0, UINT32_MAX, 0};

  (void)fault;
  types_put_4(&out, state->valid_transition_size);
  for (uint32_t i = 0; i < state->valid_transition_size; ++i) {
    types_put_transition(&out, &state->valid_transitions[i]);
  }
  return out.position;
}

static uint32_t types_encode_state(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const lifecycle_msgs__srv__GetState_Response * response = message;
  types_out_t out = {body, 0, UINT32_MAX, 0};

  (void)fault;
  types_put_state(&out, &response->current_state);
  return out.position;
}

static uint32_t types_encode_states(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const lifecycle_msgs__srv__GetAvailableStates_Response * response = message;
  types_out_t out = {body, 0, UINT32_MAX, 0};

  (void)fault;
  types_put_4(&out, (uint32_t)response->available_states.size);
  for (size_t i = 0; i < response->available_states.size; ++i) {
    types_put_state(&out, &response->available_states.data[i]);
  }
  return out.position;
}

/* As in ROS 2, an event has neither a time nor the name of its transition. */
static uint32_t types_encode_event(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const lifecycle_msgs__msg__TransitionEvent * event = message;
  types_out_t out = {body, 0, UINT32_MAX, 0};

  (void)fault;
  for (uint32_t i = 0; i < (uint32_t)EVENT_TIME_SIZE; ++i) {
    types_put(&out, 0u);
  }
  types_put_named(&out, 0u, "");
  types_put_state(&out, &event->start_state);
  types_put_state(&out, &event->goal_state);
  return out.position;
}

/* Requests have no contents. */
static void types_decode(cdr_in_t * in, void * message)
{
  (void)in;
  (void)message;
}

static const microros_message_type_t lifecycle_request_type = {
  .dds_type_name = MICROROS_ERROR_TYPE("lifecycle_msgs::srv::dds_::GetState_Request_"),
  .max_encoded_size = lifecycle_msgs__srv__GetState_Request__MAX_ENCODED_SIZE,
  .decode = types_decode};

static const microros_message_type_t transitions_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("lifecycle_msgs::srv::dds_::GetAvailableTransitions_Response_"),
  .max_encoded_size = lifecycle_msgs__srv__GetAvailableTransitions_Response__MAX_ENCODED_SIZE,
  .encode = types_encode_transitions};
static const microros_service_type_t transitions_service = {
  .dds_type_name = MICROROS_FLASH_NAME("lifecycle_msgs::srv::dds_::GetAvailableTransitions_"),
  .request = &lifecycle_request_type,
  .response = &transitions_response};
const rosidl_service_type_support_t rcl_lifecycle_transitions_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &transitions_service};

static const microros_message_type_t get_state_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("lifecycle_msgs::srv::dds_::GetState_Response_"),
  .max_encoded_size = lifecycle_msgs__srv__GetState_Response__MAX_ENCODED_SIZE,
  .encode = types_encode_state};
static const microros_service_type_t get_state_service = {
  .dds_type_name = MICROROS_FLASH_NAME("lifecycle_msgs::srv::dds_::GetState_"),
  .request = &lifecycle_request_type,
  .response = &get_state_response};
const rosidl_service_type_support_t rcl_lifecycle_state_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &get_state_service};

static const microros_message_type_t get_states_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("lifecycle_msgs::srv::dds_::GetAvailableStates_Response_"),
  .max_encoded_size = lifecycle_msgs__srv__GetAvailableStates_Response__MAX_ENCODED_SIZE,
  .encode = types_encode_states};
static const microros_service_type_t get_states_service = {
  .dds_type_name = MICROROS_FLASH_NAME("lifecycle_msgs::srv::dds_::GetAvailableStates_"),
  .request = &lifecycle_request_type,
  .response = &get_states_response};
const rosidl_service_type_support_t rcl_lifecycle_states_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &get_states_service};

static const microros_message_type_t transition_event_message = {
  .dds_type_name = MICROROS_FLASH_NAME("lifecycle_msgs::msg::dds_::TransitionEvent_"),
  .max_encoded_size = lifecycle_msgs__msg__TransitionEvent__MAX_ENCODED_SIZE,
  .encode = types_encode_event};
const rosidl_message_type_support_t rcl_lifecycle_event_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &transition_event_message};

uint32_t rcl_lifecycle_write_graph(uint32_t from, uint32_t size, uint8_t * to)
{
  types_out_t out = {to, from, size, 0};

  types_put_4(&out, RCL_LIFECYCLE_TRANSITIONS);
  for (uint32_t i = 0; i < (uint32_t)RCL_LIFECYCLE_TRANSITIONS; ++i) {
    types_put_transition(&out, &rcl_lifecycle_transitions[rcl_lifecycle_graph[i]]);
  }
  return out.position;
}
