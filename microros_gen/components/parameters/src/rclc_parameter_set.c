/* SPDX-License-Identifier: Apache-2.0 */
/* Set requests, by the rules of rclcpp: each change is checked, then the callback decides, then it is made. */
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_one_of.h"
#include "microros/rclc_parameter_string.h"
#include "microros/rclc_parameters.h"

static bool integer_holds(const rclc_parameter_range_t * range, int64_t value)
{
  uint64_t rest = 0;

  if (value == range->integer.to_value) {
    return true;
  }
  if (value < range->integer.from_value || value > range->integer.to_value) {
    return false;
  }
  if (range->integer.step != 0u) {
    (void)rclc_parameter_divide(
      (uint64_t)value - (uint64_t)range->integer.from_value, range->integer.step, &rest);
  }
  return rest == 0u;
}

static parameter_outcome_t set_check_range(
  const rclc_parameter_server_t * server, const rclc_parameter_place_t * place,
  const parameter_requested_t * requested)
{
  if (!place->has_range || requested->type != place->type) {
    return PARAMETER_SET;
  }
  if (requested->type == (uint8_t)RCLC_PARAMETER_INT) {
    return integer_holds(&place->range, requested->value.integer_value) ? PARAMETER_SET
                                                                        : PARAMETER_OUTSIDE_INTEGER;
  }
  return server->floating_point_holds(&place->range, requested->value.double_value)
           ? PARAMETER_SET
           : PARAMETER_OUTSIDE_FLOATING_POINT;
}

/* Of a parameter that does not exist, after `fresh` others that the same request creates. */
static parameter_outcome_t set_check_new(
  const rclc_parameter_server_t * server, const parameter_requested_t * requested, size_t fresh)
{
  if (!server->allow_undeclared_parameters || requested->type == (uint8_t)RCLC_PARAMETER_NOT_SET) {
    return PARAMETER_UNDECLARED;
  }
  if (requested->name.size >= (uint32_t)MICROROS_PARAMETER_NAME_SIZE) {
    return PARAMETER_NAME_LONG;
  }
  if (!rclc_parameter_holds(requested->type)) {
    return PARAMETER_UNSUPPORTED;
  }
  if (!rclc_parameter_string_fits(NULL, requested)) {
    return PARAMETER_STRING_LONG;
  }
  if (!rclc_parameter_array_fits(NULL, requested)) {
    return PARAMETER_ARRAY_LONG;
  }
  return server->count + fresh < server->max_params ? PARAMETER_SET : PARAMETER_FULL;
}

static parameter_outcome_t set_check_parameter(
  const rclc_parameter_server_t * server, const parameter_requested_t * requested, size_t fresh)
{
  const rclc_parameter_place_t * place = rclc_parameter_find(server, &requested->name);

  if (requested->name.size == 0u) {
    return PARAMETER_UNNAMED;
  }
  if (place == NULL) {
    return set_check_new(server, requested, fresh);
  }
  if (place->read_only) {
    return PARAMETER_READ_ONLY;
  }
  if (requested->type == (uint8_t)RCLC_PARAMETER_NOT_SET) {
    return place->dynamic_typing ? PARAMETER_SET : PARAMETER_STATIC;
  }
  if (requested->type != place->type && !place->dynamic_typing) {
    return PARAMETER_OTHER_TYPE;
  }
  if (!rclc_parameter_holds(requested->type)) {
    return PARAMETER_UNSUPPORTED;
  }
  if (!rclc_parameter_string_fits(place, requested)) {
    return PARAMETER_STRING_LONG;
  }
  if (!rclc_parameter_array_fits(place, requested)) {
    return PARAMETER_ARRAY_LONG;
  }
  if (!rclc_parameter_one_of(place, requested)) {
    return PARAMETER_NOT_ONE_OF;
  }
  return set_check_range(server, place, requested);
}

/* Whether the callback accepts what was checked. A name that does not exist yet is shown from a free place. */
static bool set_accepts(rclc_parameter_server_t * server, const parameter_requested_t * requested)
{
  const rclc_parameter_place_t * found = rclc_parameter_find(server, &requested->name);
  rclc_parameter_place_t * place;
  parameter_state_t old_state;
  parameter_state_t new_state;

  new_state.type = requested->type;
  new_state.value = requested->value;
  rclc_parameter_string_new(server, requested, &new_state);
  rclc_parameter_array_new(server, requested, &new_state);
  if (found == NULL) {
    new_state.name = rclc_parameter_place(server, &requested->name, requested->type)->name;
    return rclc_parameter_accepts(server, NULL, &new_state);
  }
  place = &server->places[found - server->places];
  old_state.name = place->name;
  old_state.type = place->type;
  old_state.value = place->value;
  rclc_parameter_string_old(place, &old_state);
  rclc_parameter_array_old(place, &old_state);
  new_state.name = place->name;
  return rclc_parameter_accepts(
    server, &old_state, requested->type != (uint8_t)RCLC_PARAMETER_NOT_SET ? &new_state : NULL);
}

static void set_make(rclc_parameter_server_t * server, const parameter_requested_t * requested)
{
  const rclc_parameter_place_t * found = rclc_parameter_find(server, &requested->name);
  rclc_parameter_place_t * place;

  if (found == NULL) {
    place = rclc_parameter_place(server, &requested->name, requested->type);
    place->dynamic_typing = true;
    rclc_parameter_note(server, place, PARAMETER_EVENT_NEW);
    ++server->count;
  } else {
    place = &server->places[found - server->places];
  }
  if (requested->type == (uint8_t)RCLC_PARAMETER_NOT_SET) {
    rclc_parameter_note(server, place, PARAMETER_EVENT_DELETED);
    return;
  }
  place->type = requested->type;
  place->value = requested->value;
  rclc_parameter_string_set(place, requested);
  rclc_parameter_array_set(place, requested);
  rclc_parameter_note(
    server, place,
    place->event == (uint8_t)PARAMETER_EVENT_NEW ? PARAMETER_EVENT_NEW : PARAMETER_EVENT_CHANGED);
}

void rclc_parameter_set_each(rclc_parameter_server_t * server)
{
  cdr_fault_t fault = {.field = ""};
  cdr_in_t in = rclc_parameter_request_begin(server, &fault);
  const uint32_t count = rclc_parameter_in_length(&in);

  for (uint32_t i = 0; i < count; ++i) {
    const parameter_requested_t requested = rclc_parameter_request_parameter(&in);
    parameter_outcome_t outcome = set_check_parameter(server, &requested, 0);

    if (outcome == PARAMETER_SET && !set_accepts(server, &requested)) {
      outcome = PARAMETER_REJECTED;
    }
    if (outcome == PARAMETER_SET) {
      set_make(server, &requested);
      rclc_parameter_publish(server);
    }
    server->outcomes[i] = (uint8_t)outcome;
  }
}

/* The passes over a request that is applied as a whole. */
typedef enum set_pass_t { SET_PASS_CHECK, SET_PASS_ACCEPT, SET_PASS_MAKE } set_pass_t;

/* Returns whether all parameters passed; else the outcome of the first that did not is noted. */
static bool set_pass(rclc_parameter_server_t * server, set_pass_t pass)
{
  cdr_fault_t fault = {.field = ""};
  cdr_in_t in = rclc_parameter_request_begin(server, &fault);
  const uint32_t count = rclc_parameter_in_length(&in);
  size_t fresh = 0;
  parameter_outcome_t outcome = PARAMETER_SET;

  for (uint32_t i = 0; i < count && outcome == PARAMETER_SET; ++i) {
    const parameter_requested_t requested = rclc_parameter_request_parameter(&in);

    if (pass == SET_PASS_CHECK) {
      outcome = set_check_parameter(server, &requested, fresh);
      fresh += rclc_parameter_find(server, &requested.name) == NULL ? 1u : 0u;
    } else if (pass == SET_PASS_ACCEPT) {
      outcome = set_accepts(server, &requested) ? PARAMETER_SET : PARAMETER_REJECTED;
    } else {
      set_make(server, &requested);
    }
    server->outcomes[i] = (uint8_t)outcome;
  }
  return outcome == PARAMETER_SET;
}

void rclc_parameter_set_all(rclc_parameter_server_t * server)
{
  if (set_pass(server, SET_PASS_CHECK) && set_pass(server, SET_PASS_ACCEPT)) {
    (void)set_pass(server, SET_PASS_MAKE);
    rclc_parameter_publish(server);
  }
}
