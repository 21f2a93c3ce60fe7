/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc_lifecycle/rclc_lifecycle.h"

#include "microros/error.h"
#include "microros/rcl_lifecycle_types.h"
#include "microros/rclc_lifecycle_change.h"

#include <string.h>

rcl_ret_t rclc_make_node_a_lifecycle_node(
  rclc_lifecycle_node_t * lifecycle_node, rcl_node_t * node, rcl_lifecycle_state_machine_t * state_machine,
  rcl_allocator_t * allocator, bool enable_communication_interface)
{
  rcl_lifecycle_state_machine_options_t options;
  rcl_ret_t result;

  if (lifecycle_node == NULL || node == NULL || state_machine == NULL || allocator == NULL) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "lifecycle_node, node, state_machine or allocator");
  }
  options.initialize_default_states = true;
  options.enable_com_interface = enable_communication_interface;
  options.allocator = *allocator;
  (void)memset(lifecycle_node, 0, sizeof(*lifecycle_node)); /* it may be uninitialized memory */
  result = rcl_lifecycle_state_machine_init(
    state_machine, node, &rcl_lifecycle_event_type, &rclc_lifecycle_change_type, &rcl_lifecycle_state_type,
    &rcl_lifecycle_states_type, NULL, NULL, &options);
  if (result != RCL_RET_OK) {
    return result;
  }
  lifecycle_node->node = node;
  lifecycle_node->state_machine = state_machine;
  lifecycle_node->publish_transitions = enable_communication_interface;
  lifecycle_node->cs_req.transition.label.data = lifecycle_node->label;
  lifecycle_node->cs_req.transition.label.capacity = sizeof(lifecycle_node->label);
  return RCL_RET_OK;
}

static rcl_ret_t lifecycle_check(const rclc_lifecycle_node_t * node)
{
  if (node == NULL || node->state_machine == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "lifecycle_node");
  }
  return rcl_lifecycle_state_machine_is_initialized(node->state_machine);
}

rcl_ret_t rclc_lifecycle_node_fini(rclc_lifecycle_node_t * node, rcl_allocator_t * allocator)
{
  rcl_ret_t result = lifecycle_check(node);

  if (result == RCL_RET_OK && allocator == NULL) {
    result = microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "allocator");
  }
  if (result == RCL_RET_OK) {
    result = rcl_lifecycle_state_machine_fini(node->state_machine, node->node);
  }
  return result;
}

rcl_ret_t rclc_lifecycle_register_callback(
  rclc_lifecycle_node_t * lifecycle_node, unsigned int goal_state, int (*cb)(void))
{
  if (
    lifecycle_node == NULL || cb == NULL || goal_state >= (unsigned int)RCLC_LIFECYCLE_MAX_NUMBER_OF_STATES) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "lifecycle_node, goal_state or callback");
  }
  lifecycle_node->callbacks.goal_states[goal_state] = true;
  lifecycle_node->callbacks.fun_ptrs[goal_state] = cb;
  return RCL_RET_OK;
}

rcl_ret_t rclc_lifecycle_register_on_configure(rclc_lifecycle_node_t * node, int (*cb)(void))
{
  return rclc_lifecycle_register_callback(node, lifecycle_msgs__msg__Transition__TRANSITION_CONFIGURE, cb);
}

rcl_ret_t rclc_lifecycle_register_on_activate(rclc_lifecycle_node_t * node, int (*cb)(void))
{
  return rclc_lifecycle_register_callback(node, lifecycle_msgs__msg__Transition__TRANSITION_ACTIVATE, cb);
}

rcl_ret_t rclc_lifecycle_register_on_deactivate(rclc_lifecycle_node_t * node, int (*cb)(void))
{
  return rclc_lifecycle_register_callback(node, lifecycle_msgs__msg__Transition__TRANSITION_DEACTIVATE, cb);
}

rcl_ret_t rclc_lifecycle_register_on_cleanup(rclc_lifecycle_node_t * node, int (*cb)(void))
{
  return rclc_lifecycle_register_callback(node, lifecycle_msgs__msg__Transition__TRANSITION_CLEANUP, cb);
}

rcl_ret_t rclc_lifecycle_execute_callback(rclc_lifecycle_node_t * lifecycle_node, unsigned int transition_id)
{
  int (*cb)(void);

  if (lifecycle_node == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "lifecycle_node");
  }
  if (
    transition_id >= (unsigned int)RCLC_LIFECYCLE_MAX_NUMBER_OF_STATES ||
    !lifecycle_node->callbacks.goal_states[transition_id]) {
    return RCL_RET_OK;
  }
  cb = lifecycle_node->callbacks.fun_ptrs[transition_id];
  return cb();
}

/* Calls a callback and leaves the transition state by what it returned, which is the position of the transition. */
static lifecycle_outcome_t lifecycle_call(
  rclc_lifecycle_node_t * node, unsigned int callback, bool publish_update)
{
  const rcl_lifecycle_state_t * state = node->state_machine->current_state;
  const rcl_ret_t returned = rclc_lifecycle_execute_callback(node, callback);
  lifecycle_outcome_t outcome = LIFECYCLE_FAILURE;

  if (returned == RCL_RET_OK || returned == lifecycle_msgs__msg__Transition__TRANSITION_CALLBACK_SUCCESS) {
    outcome = LIFECYCLE_SUCCESS;
  } else if (returned == lifecycle_msgs__msg__Transition__TRANSITION_CALLBACK_ERROR) {
    outcome = LIFECYCLE_ERROR;
  }
  /* Fails if the callback itself has gone on, which is then the new state. */
  if (
    node->state_machine->current_state != state ||
    rcl_lifecycle_trigger_transition_by_id(
      node->state_machine, (uint8_t)state->valid_transitions[outcome].id, publish_update) != RCL_RET_OK) {
    outcome = LIFECYCLE_REFUSED;
  }
  return outcome;
}

lifecycle_outcome_t rclc_lifecycle_change(
  rclc_lifecycle_node_t * lifecycle_node, unsigned int transition_id, bool publish_update)
{
  const unsigned int error_id = lifecycle_msgs__msg__State__TRANSITION_STATE_ERRORPROCESSING;
  rcl_lifecycle_state_machine_t * machine = lifecycle_node->state_machine;
  lifecycle_outcome_t outcome;

  if (
    transition_id > (unsigned int)UINT8_MAX ||
    rcl_lifecycle_trigger_transition_by_id(machine, (uint8_t)transition_id, publish_update) != RCL_RET_OK) {
    return LIFECYCLE_REFUSED;
  }
  if (machine->current_state->id <= (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_FINALIZED) {
    return LIFECYCLE_SUCCESS; /* a transition that ends a transition state */
  }
  outcome = lifecycle_call(
    lifecycle_node, machine->current_state->id == error_id ? error_id : transition_id, publish_update);
  if (
    outcome == LIFECYCLE_ERROR && machine->current_state->id == error_id &&
    lifecycle_call(lifecycle_node, error_id, publish_update) == LIFECYCLE_REFUSED) {
    outcome = LIFECYCLE_REFUSED;
  }
  return outcome;
}

rcl_ret_t rclc_lifecycle_change_state(
  rclc_lifecycle_node_t * lifecycle_node, unsigned int transition_id, bool publish_update)
{
  const rcl_ret_t result = lifecycle_check(lifecycle_node);

  if (result != RCL_RET_OK) {
    return result == RCL_RET_INVALID_ARGUMENT && lifecycle_node != NULL ? RCL_RET_ERROR : result;
  }
  return rclc_lifecycle_change(lifecycle_node, transition_id, publish_update) == LIFECYCLE_REFUSED
           ? RCL_RET_ERROR
           : RCL_RET_OK;
}
