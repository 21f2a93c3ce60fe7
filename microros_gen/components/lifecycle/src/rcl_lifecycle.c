/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_lifecycle/rcl_lifecycle.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_lifecycle_answer.h"
#include "microros/rcl_lifecycle_events.h"
#include "microros/rcl_lifecycle_states.h"
#include "microros/rcl_lifecycle_timers.h"
#include "microros/rcl_lifecycle_types.h"
#include "microros/rmw_by_place.h"
#include "microros/rmw_lifecycle.h"
#include "microros/text.h"

#include <stddef.h>
#include <string.h>

rcl_lifecycle_state_machine_options_t rcl_lifecycle_get_default_state_machine_options(void)
{
  rcl_lifecycle_state_machine_options_t options;

  (void)memset(&options, 0, sizeof(options));
  options.initialize_default_states = true;
  options.enable_com_interface = true;
  options.allocator = rcl_get_default_allocator();
  return options;
}

rcl_lifecycle_state_machine_t rcl_lifecycle_get_zero_initialized_state_machine(void)
{
  rcl_lifecycle_state_machine_t machine;

  (void)memset(&machine, 0, sizeof(machine));
  machine.options = rcl_lifecycle_get_default_state_machine_options();
  return machine;
}

enum { MACHINE_SERVICES = 5 };

/* As in rmw_qos_profile_services_default and in that of the publisher. */
enum { MACHINE_DEPTH = 10 };

/* The services, in the order in which they are opened. */
static void machine_list(rcl_lifecycle_com_interface_t * offers, rcl_service_t * services[MACHINE_SERVICES])
{
  services[0] = &offers->srv_change_state;
  services[1] = &offers->srv_get_available_states;
  services[2] = &offers->srv_get_available_transitions;
  services[3] = &offers->srv_get_state;
  services[4] = &offers->srv_get_transition_graph;
}

/* Closes what is open. Returns the first error. */
static rcl_ret_t machine_close(rcl_lifecycle_com_interface_t * offers, rcl_node_t * node)
{
  rcl_service_t * services[MACHINE_SERVICES];
  rcl_ret_t first = rcl_publisher_fini(&offers->pub_transition_event, node);

  if (rcl_service_is_valid(&offers->srv_change_state)) {
    rmw_lifecycle_answer_large(offers->srv_change_state.impl, false);
  }
  machine_list(offers, services);
  for (size_t i = 0; i < (size_t)MACHINE_SERVICES; ++i) {
    const rcl_ret_t result = rcl_service_fini(services[i], node);

    first = first == RCL_RET_OK ? result : first;
  }
  return first;
}

/* Opens the services of these types; the node was looked at. They are in the order of the plan, which has their places. */
static rcl_ret_t machine_offer(
  rcl_lifecycle_com_interface_t * offers, const rosidl_service_type_support_t * const types[MACHINE_SERVICES])
{
  rcl_service_t * services[MACHINE_SERVICES];
  rcl_ret_t result = RCL_RET_OK;
  uint16_t at = 0;

  machine_list(offers, services);
  for (size_t i = 0; i < (size_t)MACHINE_SERVICES && result == RCL_RET_OK; ++i) {
    result = types[i] != NULL
               ? rmw_replier_open_by_place(
                   offers->node_handle->impl, types[i], (uint16_t)MACHINE_DEPTH, &at, &services[i]->impl)
               : microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "type of a service");
  }
  if (result == RCL_RET_OK) {
    rmw_lifecycle_answer_large(offers->srv_change_state.impl, true);
  }
  return result;
}

/* Returns the state in which a node begins: after a sleep the one before it. */
static const rcl_lifecycle_state_t * machine_first_state(const rcl_node_t * node)
{
  const uint8_t before = rmw_lifecycle_state(node->impl);
  const uint8_t id = before != 0u ? before : (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_UNCONFIGURED;

  return &rcl_lifecycle_states[id]; /* the id of a primary state is its position */
}

static void machine_begin(rcl_lifecycle_state_machine_t * machine)
{
  const rcl_node_t * node = machine->com_interface.node_handle;

  machine->transition_map.states = rcl_lifecycle_states;
  machine->transition_map.states_size = RCL_LIFECYCLE_STATES;
  machine->transition_map.transitions = rcl_lifecycle_transitions;
  machine->transition_map.transitions_size = RCL_LIFECYCLE_TRANSITIONS;
  machine->current_state = machine_first_state(node);
  rmw_lifecycle_set_state(node->impl, machine->current_state->id);
  rcl_lifecycle_answer_for(machine);
}

rcl_ret_t rcl_lifecycle_state_machine_init(
  rcl_lifecycle_state_machine_t * state_machine, rcl_node_t * node_handle,
  const rosidl_message_type_support_t * ts_pub_notify,
  const rosidl_service_type_support_t * ts_srv_change_state,
  const rosidl_service_type_support_t * ts_srv_get_state,
  const rosidl_service_type_support_t * ts_srv_get_available_states,
  const rosidl_service_type_support_t * ts_srv_get_available_transitions,
  const rosidl_service_type_support_t * ts_srv_get_transition_graph,
  const rcl_lifecycle_state_machine_options_t * state_machine_options)
{
  rcl_lifecycle_com_interface_t * offers;
  rcl_ret_t result;

  (void)ts_srv_get_available_transitions;
  (void)ts_srv_get_transition_graph;
  if (
    state_machine == NULL || node_handle == NULL || ts_pub_notify == NULL || state_machine_options == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "state_machine, node, type or options");
  }
  if (!rcl_node_is_valid(node_handle)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (!state_machine_options->initialize_default_states) {
    return microros_error_named(RCL_RET_UNSUPPORTED, microros_error_lifecycle, "it has the default states");
  }
  (void)memset(state_machine, 0, sizeof(*state_machine)); /* it may be uninitialized memory */
  state_machine->options = *state_machine_options;
  offers = &state_machine->com_interface;
  offers->node_handle = node_handle;
  result = rmw_publisher_open_by_place(
    node_handle->impl, ts_pub_notify, (uint16_t)MACHINE_DEPTH, &offers->pub_transition_event.impl);
  if (result == RCL_RET_OK && state_machine->options.enable_com_interface) {
    const rosidl_service_type_support_t * const types[MACHINE_SERVICES] = {
      ts_srv_change_state, ts_srv_get_available_states, &rcl_lifecycle_transitions_type, ts_srv_get_state,
      &rcl_lifecycle_transitions_type};

    result = machine_offer(offers, types);
  }
  if (result == RCL_RET_OK) {
    machine_begin(state_machine);
  } else {
    (void)machine_close(offers, node_handle); /* the first error is reported */
  }
  return result;
}

rcl_ret_t rcl_lifecycle_state_machine_is_initialized(const rcl_lifecycle_state_machine_t * state_machine)
{
  return state_machine != NULL && state_machine->current_state != NULL
           ? RCL_RET_OK
           : microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "state_machine");
}

rcl_ret_t rcl_lifecycle_state_machine_fini(
  rcl_lifecycle_state_machine_t * state_machine, rcl_node_t * node_handle)
{
  rcl_ret_t result;

  if (state_machine == NULL || node_handle == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "state_machine or node");
  }
  rcl_lifecycle_answer_no_longer(state_machine);
  if (rcl_node_is_valid(node_handle)) {
    microros_lock();
    rmw_lifecycle_set_state(node_handle->impl, 0u);
    rcl_lifecycle_events_clear(node_handle);
    microros_unlock();
  }
  result = machine_close(&state_machine->com_interface, node_handle);
  *state_machine = rcl_lifecycle_get_zero_initialized_state_machine();
  return result;
}

const rcl_lifecycle_transition_t * rcl_lifecycle_get_transition_by_id(
  const rcl_lifecycle_state_t * state, uint8_t id)
{
  if (state != NULL) {
    for (unsigned int i = 0; i < state->valid_transition_size; ++i) {
      if (state->valid_transitions[i].id == id) {
        return &state->valid_transitions[i];
      }
    }
  }
  return NULL;
}

const rcl_lifecycle_transition_t * rcl_lifecycle_get_transition_by_label(
  const rcl_lifecycle_state_t * state, const char * label)
{
  if (state != NULL && label != NULL) {
    for (unsigned int i = 0; i < state->valid_transition_size; ++i) {
      if (microros_text_equals(state->valid_transitions[i].label, label)) {
        return &state->valid_transitions[i];
      }
    }
  }
  return NULL;
}

static bool machine_is_primary(const rcl_lifecycle_state_t * state)
{
  return state->id <= (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_FINALIZED;
}

static rcl_ret_t machine_go(
  rcl_lifecycle_state_machine_t * machine, const rcl_lifecycle_transition_t * transition, bool publish)
{
  if (transition == NULL) {
    return microros_error_named(
      RCL_RET_INVALID_ARGUMENT, microros_error_transition, machine->current_state->label);
  }
  microros_lock(); /* whichever task receives answers with the state and publishes what happened */
  machine->current_state = transition->goal;
  if (machine_is_primary(transition->goal)) {
    rmw_lifecycle_set_state(machine->com_interface.node_handle->impl, transition->goal->id);
  }
  if (publish) {
    rcl_lifecycle_events_add(&machine->com_interface, transition);
  }
  microros_unlock();
  if (transition->goal->id == (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_ACTIVE) {
    rcl_lifecycle_timers_start(machine->com_interface.node_handle);
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_lifecycle_trigger_transition_by_id(
  rcl_lifecycle_state_machine_t * state_machine, uint8_t id, bool publish_notification)
{
  const rcl_ret_t result = rcl_lifecycle_state_machine_is_initialized(state_machine);

  return result == RCL_RET_OK
           ? machine_go(
               state_machine, rcl_lifecycle_get_transition_by_id(state_machine->current_state, id),
               publish_notification)
           : result;
}

rcl_ret_t rcl_lifecycle_trigger_transition_by_label(
  rcl_lifecycle_state_machine_t * state_machine, const char * label, bool publish_notification)
{
  const rcl_ret_t result = rcl_lifecycle_state_machine_is_initialized(state_machine);

  return result == RCL_RET_OK
           ? machine_go(
               state_machine, rcl_lifecycle_get_transition_by_label(state_machine->current_state, label),
               publish_notification)
           : result;
}
