/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A mode is applied as a whole: first it is checked that everything fits, then the callback decides about each value,
 * then all are set. Values were checked against their declarations when the tool ran; so this only finds out what the
 * application has changed since: parameters that are deleted or have less room.
 */
#include "microros/error.h"
#include "microros/rclc_modes_table.h"
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_string.h"
#include "microros/rclc_parameters.h"

#include <string.h>

typedef enum modes_pass_t { MODES_PASS_CHECK, MODES_PASS_ASK, MODES_PASS_SET } modes_pass_t;

/* Fills the state that a parameter has in a mode, whose text or array belongs to the server; false: it does not fit. */
static bool modes_state(
  rclc_parameter_server_t * server, const rclc_parameter_place_t * place, const rclc_modes_value_t * value,
  parameter_state_t * state)
{
  rclc_parameter_declared_t declared;

  (void)memset(&declared, 0, sizeof(declared));
  declared.value = value->value;
  declared.about = *place->about;
  declared.type = place->type;
#if MICROROS_PARAMETER_STRING_SIZE > 0u || MICROROS_PARAMETER_ARRAY_SIZE > 0u
  declared.start = value->start;
  declared.start_bytes = value->start_bytes;
  declared.start_count = value->start_count;
#endif
  state->value = value->value;
  return rclc_parameter_string_start(server, &declared, state) &&
         rclc_parameter_array_start(server, &declared, state);
}

static rcl_ret_t modes_apply_one(
  rclc_parameter_server_t * server, const rclc_modes_parameter_t * parameter,
  const rclc_modes_value_t * value, modes_pass_t pass)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(server, parameter->name, &result);
  parameter_state_t old_state;
  parameter_state_t new_state;

  if (!rclc_parameter_is(place, parameter->name, parameter->type, &result, RCL_RET_ERROR)) {
    return result;
  }
  old_state = rclc_parameter_state(place);
  new_state = old_state;
  if (!modes_state(server, place, value, &new_state)) {
    return rclc_parameter_refuse(RCL_RET_ERROR, parameter->name, MICROROS_ERROR_WORDS("too long a value"));
  }
  if (pass == MODES_PASS_ASK && !rclc_parameter_accepts(server, &old_state, &new_state)) {
    return rclc_parameter_refuse(
      RCLC_PARAMETER_MODIFICATION_REJECTED, parameter->name,
      MICROROS_ERROR_WORDS("the callback refused the value"));
  }
  if (pass == MODES_PASS_SET) {
    place->value = new_state.value;
    rclc_parameter_string_take(place, &new_state);
    rclc_parameter_array_take(place, &new_state);
    rclc_parameter_note(server, place, PARAMETER_EVENT_CHANGED);
  }
  return RCL_RET_OK;
}

/* Returns the first error; those of the last pass are excluded by the one before it. */
static rcl_ret_t modes_apply_pass(
  rclc_parameter_server_t * server, const rclc_modes_table_t * table, const rclc_modes_mode_t * mode,
  modes_pass_t pass)
{
  rcl_ret_t result = RCL_RET_OK;

  for (size_t i = 0; i < table->parameter_count && result == RCL_RET_OK; ++i) {
    if (mode->given == NULL || mode->given[i]) {
      result = modes_apply_one(server, &table->parameters[i], &mode->values[i], pass);
    }
  }
  return result;
}

rcl_ret_t rclc_modes_apply(
  rclc_parameter_server_t * server, const rclc_modes_table_t * table, uint8_t mode, bool asks)
{
  const rclc_modes_mode_t * applied = &table->modes[mode];
  rcl_ret_t result = modes_apply_pass(server, table, applied, MODES_PASS_CHECK);

  if (result == RCL_RET_OK && asks) {
    result = modes_apply_pass(server, table, applied, MODES_PASS_ASK);
  }
  if (result == RCL_RET_OK) {
    result = modes_apply_pass(server, table, applied, MODES_PASS_SET);
    rclc_parameter_publish(server);
  }
  return result;
}

/* Requests a transition; returns whether the node is in that state then. */
static bool modes_go(const rclc_modes_t * modes, unsigned int transition, uint8_t state)
{
  rclc_lifecycle_node_t * node = modes->lifecycle_node;

  (void)rclc_lifecycle_change_state(node, transition, node->publish_transitions);
  return rclc_modes_state(modes) == state;
}

static bool modes_activate(const rclc_modes_t * modes)
{
  return modes_go(
    modes, lifecycle_msgs__msg__Transition__TRANSITION_ACTIVATE,
    (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_ACTIVE);
}

static rcl_ret_t modes_refuse_transition(const rclc_modes_t * modes, uint8_t mode)
{
  return rclc_modes_refuse(
    RCL_RET_ERROR, rclc_modes_name(modes, mode), MICROROS_ERROR_WORDS("a transition of the node failed"));
}

/* For a node that did not become active in the new mode: back to the former one, and once more. */
static rcl_ret_t modes_return(rclc_modes_t * modes, uint8_t mode, uint8_t former_mode)
{
  if (rclc_modes_switch(modes, former_mode, false) == RCL_RET_OK) {
    (void)modes_activate(modes);
  }
  return modes_refuse_transition(modes, mode);
}

/* For a node that was active and is inactive now. */
static rcl_ret_t modes_reconfigure(rclc_modes_t * modes, uint8_t mode)
{
  const uint8_t former_mode = modes->mode;
  const rcl_ret_t result = rclc_modes_switch(modes, mode, true);

  if (result != RCL_RET_OK) {
    (void)modes_activate(modes); /* the refusal is reported */
    return result;
  }
  if (!modes_activate(modes)) {
    return modes_return(modes, mode, former_mode);
  }
  rclc_modes_notify(modes, former_mode);
  return RCL_RET_OK;
}

rcl_ret_t rclc_modes_reconfigure(rclc_modes_t * modes, uint8_t mode)
{
  const rcl_ret_t result = rclc_modes_may_change(modes, mode);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (rclc_modes_state(modes) == (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_INACTIVE) {
    return rclc_modes_change(modes, mode);
  }
  if (!modes_go(
        modes, lifecycle_msgs__msg__Transition__TRANSITION_DEACTIVATE,
        (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_INACTIVE)) {
    return modes_refuse_transition(modes, mode);
  }
  return modes_reconfigure(modes, mode);
}
