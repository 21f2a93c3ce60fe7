/* SPDX-License-Identifier: Apache-2.0 */
/* Lists of transitions, written from the constants: that of one state into the stream, the whole graph in pieces. */
#include "microros/rcl_lifecycle_answer.h"

#include "lifecycle_msgs/srv/get_available_transitions.h"
#include "microros/cdr_decode.h"
#include "microros/error.h"
#include "microros/rcl_lifecycle_events.h"
#include "microros/rcl_lifecycle_states.h"
#include "microros/rmw_lifecycle.h"
#include "microros/rmw_node.h"
#include "microros/rmw_service.h"
#include "microros/service_type.h"
#include "microros/text.h"
#include "microros_config.h"
#include "rcl/error_handling.h"
#include "rcl/service.h"

#include <stddef.h>

static rcl_lifecycle_state_machine_t * answer_machines[MICROROS_NODES_MAX];

/* A part of a body: its bytes from `from` on, at most `size`, go to `to`. */
typedef struct answer_out_t {
  uint8_t * to;
  uint32_t from;
  uint32_t size;
  uint32_t position; /* in the whole body */
} answer_out_t;

static void answer_put(answer_out_t * out, uint8_t byte)
{
  const uint32_t at = out->position - out->from; /* wraps to a large number before `from` */

  if (at < out->size) {
    out->to[at] = byte;
  }
  ++out->position;
}

static void answer_put_4(answer_out_t * out, uint32_t number)
{
  while (out->position % 4u != 0u) {
    answer_put(out, 0u);
  }
  for (uint32_t shift = 0; shift < 32u; shift += 8u) {
    answer_put(out, (uint8_t)(number >> shift & 0xffu));
  }
}

/* Writes an id and a label: a lifecycle_msgs/msg/State or lifecycle_msgs/msg/Transition. */
static void answer_put_named(answer_out_t * out, uint8_t id, const char * label)
{
  const size_t size = microros_text_size(label) + 1u;

  answer_put(out, id);
  answer_put_4(out, (uint32_t)size);
  for (size_t i = 0; i < size; ++i) {
    answer_put(out, (uint8_t)label[i]);
  }
}

static void answer_put_transitions(
  answer_out_t * out, const rcl_lifecycle_transition_t * transitions, uint32_t count)
{
  answer_put_4(out, count);
  for (uint32_t i = 0; i < count; ++i) {
    const rcl_lifecycle_transition_t * transition = &transitions[i];

    answer_put_named(out, (uint8_t)transition->id, transition->label);
    answer_put_named(out, transition->start->id, transition->start->label);
    answer_put_named(out, transition->goal->id, transition->goal->label);
  }
}

/* The message is a state. */
static uint32_t answer_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rcl_lifecycle_state_t * state = message;
  answer_out_t out = {
    body, 0, lifecycle_msgs__srv__GetAvailableTransitions_Response__MAX_ENCODED_SIZE, 0};

  (void)fault;
  answer_put_transitions(&out, state->valid_transitions, state->valid_transition_size);
  return out.position;
}

/* A request has no contents. */
static void answer_decode(cdr_in_t * in, void * message)
{
  (void)in;
  (void)message;
}

static const microros_message_type_t answer_request = {
  .dds_type_name = MICROROS_ERROR_WORDS("lifecycle_msgs::srv::dds_::GetAvailableTransitions_Request_"),
  .max_encoded_size = lifecycle_msgs__srv__GetAvailableTransitions_Request__MAX_ENCODED_SIZE,
  .decode = answer_decode};
static const microros_message_type_t answer_response = {
  .dds_type_name = MICROROS_ERROR_WORDS("lifecycle_msgs::srv::dds_::GetAvailableTransitions_Response_"),
  .max_encoded_size = lifecycle_msgs__srv__GetAvailableTransitions_Response__MAX_ENCODED_SIZE,
  .encode = answer_encode};
static const microros_service_type_t answer_service = {
  .dds_type_name = "lifecycle_msgs::srv::dds_::GetAvailableTransitions_",
  .request = &answer_request,
  .response = &answer_response};
const rosidl_service_type_support_t rcl_lifecycle_transitions_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &answer_service};

/* Writes a part of ~/get_transition_graph's response. */
static uint32_t answer_graph(uint32_t from, uint32_t size, uint8_t * to)
{
  answer_out_t out = {to, from, size, 0};

  answer_put_transitions(&out, rcl_lifecycle_transitions, RCL_LIFECYCLE_TRANSITIONS);
  return out.position;
}

void rcl_lifecycle_answer_for(rcl_lifecycle_state_machine_t * state_machine)
{
  const rcl_node_t * node = state_machine->com_interface.node_handle;

  answer_machines[rmw_node_index(node->impl)] = state_machine;
  rmw_lifecycle_use(node->impl, answer_graph);
}

void rcl_lifecycle_answer_no_longer(const rcl_lifecycle_state_machine_t * state_machine)
{
  for (size_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    if (answer_machines[i] == state_machine) {
      answer_machines[i] = NULL;
    }
  }
}

void rcl_lifecycle_leave(const rcl_node_t * node)
{
  answer_machines[rmw_node_index(node->impl)] = NULL;
  rmw_lifecycle_set_state(node->impl, 0u);
  rcl_lifecycle_events_clear(node);
}

/* Takes a request; false: there is none, or it is not of its type. */
static bool answer_take(const rcl_service_t * service, rmw_request_id_t * request)
{
  lifecycle_msgs__srv__GetAvailableTransitions_Request nothing;

  if (!rcl_service_is_valid(service) || !rmw_replier_is_ready(service->impl)) {
    return false;
  }
  if (rcl_take_request(service, request, &nothing) != RCL_RET_OK) {
    rcl_reset_error(); /* counted */
    return false;
  }
  return true;
}

static void answer_requests(rcl_lifecycle_state_machine_t * machine)
{
  rcl_lifecycle_com_interface_t * offers = &machine->com_interface;
  rcl_lifecycle_state_t state = *machine->current_state;
  rmw_request_id_t request;

  rcl_lifecycle_events_send(offers);
  if (answer_take(&offers->srv_get_available_transitions, &request)) {
    if (rcl_send_response(&offers->srv_get_available_transitions, &request, &state) != RCL_RET_OK) {
      rcl_reset_error(); /* there is room for what was taken; else it is counted */
    }
  }
  if (
    !rmw_lifecycle_is_replying(offers->node_handle->impl) &&
    answer_take(&offers->srv_get_transition_graph, &request)) {
    rmw_lifecycle_reply(offers->srv_get_transition_graph.impl, &request);
  }
}

void rcl_lifecycle_answer(void)
{
  for (size_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    if (answer_machines[i] != NULL) {
      answer_requests(answer_machines[i]);
    }
  }
}
