/* SPDX-License-Identifier: Apache-2.0 */
/* Set requests, by the rules of rclcpp: each change is checked, then the callback decides, then it is made. */
#include "microros/rclc_parameters.h"

#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_one_of.h"
#include "microros/rclc_parameter_rules.h"
#include "microros/rclc_parameter_string.h"

uint64_t rclc_parameter_divide(uint64_t value, uint64_t by, uint64_t * rest)
{
  uint64_t quotient = 0;
  uint64_t left = value;
  uint64_t step = by;
  uint64_t bit = 1;

  if ((value | by) <= UINT32_MAX) { /* as most values of parameters: processors divide these */
    const uint32_t divisor = (uint32_t)by;
    const uint32_t whole = (uint32_t)value / divisor;
    const uint32_t remainder = (uint32_t)value - whole * divisor;

    *rest = remainder;
    return whole;
  }
  while (step <= left / 2u) {
    step <<= 1;
    bit <<= 1;
  }
  while (bit != 0u) {
    if (left >= step) {
      left -= step;
      quotient |= bit;
    }
    step >>= 1;
    bit >>= 1;
  }
  *rest = left;
  return quotient;
}

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

/* For a value of the type that the parameter has: its range is of that type. */
static parameter_outcome_t set_check_range(
  const rclc_parameter_server_t * server, const rclc_parameter_place_t * place,
  const parameter_requested_t * requested)
{
  const rclc_parameter_range_t * range = place->about->range;

  if (range == NULL) {
    return PARAMETER_SET;
  }
  if (requested->type == (uint8_t)RCLC_PARAMETER_INT) {
    return integer_holds(range, requested->value.integer_value) ? PARAMETER_SET : PARAMETER_OUTSIDE_INTEGER;
  }
  return server->floating_point_holds(range, requested->value.double_value)
           ? PARAMETER_SET
           : PARAMETER_OUTSIDE_FLOATING_POINT;
}

/* For one of `created` parameters that do not exist yet; 0: for one that gets another type. */
static parameter_outcome_t set_check_new(
  const rclc_parameter_server_t * server, const parameter_requested_t * requested, size_t created)
{
  if (server->undeclared == NULL || requested->type == (uint8_t)RCLC_PARAMETER_NOT_SET) {
    return PARAMETER_UNDECLARED;
  }
  return server->undeclared->check(server, requested, created);
}

/* For a value of the type that the parameter has. */
static parameter_outcome_t set_check_value(
  const rclc_parameter_server_t * server, const rclc_parameter_place_t * place,
  const parameter_requested_t * requested)
{
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

/* `place`: the one of that name, or NULL; so it is below. */
static parameter_outcome_t set_check_parameter(
  const rclc_parameter_server_t * server, const rclc_parameter_place_t * place,
  const parameter_requested_t * requested, size_t created)
{
  if (requested->name.size == 0u) {
    return PARAMETER_UNNAMED;
  }
  if (place == NULL) {
    return set_check_new(server, requested, created);
  }
  if (place->read_only) {
    return PARAMETER_READ_ONLY;
  }
  if (requested->type == (uint8_t)RCLC_PARAMETER_NOT_SET) {
    return place->dynamic_typing ? PARAMETER_SET : PARAMETER_STATIC;
  }
  if (requested->type != place->type) {
    return place->dynamic_typing ? set_check_new(server, requested, 0) : PARAMETER_OTHER_TYPE;
  }
  return rclc_parameter_rules_outcome(place, requested, set_check_value(server, place, requested));
}

/* Returns whether the callback accepts a checked change. */
static bool set_accepts(
  rclc_parameter_server_t * server, const rclc_parameter_place_t * found,
  const parameter_requested_t * requested)
{
  parameter_state_t old_state;
  parameter_state_t new_state;

  new_state.type = requested->type;
  new_state.value = requested->value;
  rclc_parameter_string_new(server, requested, &new_state);
  rclc_parameter_array_new(server, requested, &new_state);
  if (found == NULL) {
    return server->undeclared->accepts(server, &requested->name, &new_state);
  }
  old_state = rclc_parameter_state(&server->places[found - server->places]);
  new_state.name = old_state.name;
  return rclc_parameter_accepts(
    server, &old_state, requested->type != (uint8_t)RCLC_PARAMETER_NOT_SET ? &new_state : NULL);
}

static void set_make(
  rclc_parameter_server_t * server, const rclc_parameter_place_t * found_place,
  const parameter_requested_t * requested)
{
  const rclc_parameter_place_t * found = found_place;
  rclc_parameter_place_t * place;

  if (found == NULL && requested->type != (uint8_t)RCLC_PARAMETER_NOT_SET) {
    server->undeclared->add(server, requested);
    found = rclc_parameter_find(server, &requested->name);
  }
  if (found == NULL) {
    return; /* deleted by an earlier entry of the same request */
  }
  place = &server->places[found - server->places];
  if (requested->type == (uint8_t)RCLC_PARAMETER_NOT_SET) {
    rclc_parameter_note(server, place, PARAMETER_EVENT_DELETED);
    return;
  }
  if (place->type != requested->type) {
    server->undeclared->retype(server, place, requested->type);
  }
  place->value = requested->value;
  rclc_parameter_string_set(place, requested);
  rclc_parameter_array_set(place, requested);
  rclc_parameter_note(server, place, PARAMETER_EVENT_CHANGED);
}

void rclc_parameter_set_each(rclc_parameter_server_t * server)
{
  cdr_in_t in = rclc_parameter_request_begin(server);
  const uint32_t count = rclc_parameter_in_length(&in);

  for (uint32_t i = 0; i < count; ++i) {
    parameter_requested_t requested;
    const rclc_parameter_place_t * found;
    parameter_outcome_t outcome;

    rclc_parameter_request_parameter(&in, &requested);
    found = rclc_parameter_find(server, &requested.name);
    outcome = set_check_parameter(server, found, &requested, 1);
    if (outcome == PARAMETER_SET && !set_accepts(server, found, &requested)) {
      outcome = PARAMETER_REJECTED;
    }
    if (outcome == PARAMETER_SET) {
      set_make(server, found, &requested);
      rclc_parameter_publish(server);
    }
    server->outcomes[i] = (uint8_t)outcome;
  }
}

/* The passes over a request that is applied as a whole. As in rclcpp, a name that is set and deleted is deleted, whatever
 * the order of the two, so what is deleted comes last. */
typedef enum set_pass_t { SET_PASS_CHECK, SET_PASS_ACCEPT, SET_PASS_MAKE, SET_PASS_DELETE } set_pass_t;

static bool set_is_same_name(const parameter_text_t * one, const parameter_text_t * other)
{
  uint32_t i = 0;

  while (i < one->size && i < other->size && one->data[i] == other->data[i]) {
    ++i;
  }
  return i == one->size && i == other->size;
}

/* Returns whether one of the first `count` entries of the request has that name. */
static bool set_has_name(
  const rclc_parameter_server_t * server, uint32_t count, const parameter_text_t * name)
{
  cdr_in_t in = rclc_parameter_request_begin(server);
  bool found = false;

  (void)rclc_parameter_in_length(&in);
  for (uint32_t i = 0; i < count && !found; ++i) {
    parameter_requested_t earlier;

    rclc_parameter_request_parameter(&in, &earlier);
    found = set_is_same_name(&earlier.name, name);
  }
  return found;
}

/* Makes a change in its pass: what is deleted comes last. */
static void set_make_in_pass(
  rclc_parameter_server_t * server, const rclc_parameter_place_t * found,
  const parameter_requested_t * requested, set_pass_t pass)
{
  const bool deletes = requested->type == (uint8_t)RCLC_PARAMETER_NOT_SET;

  if (deletes ? pass == SET_PASS_DELETE : pass == SET_PASS_MAKE) {
    set_make(server, found, requested);
  }
}

/* Returns whether all parameters passed; if not, stores the outcome of the first one that did not. */
static bool set_pass(rclc_parameter_server_t * server, set_pass_t pass)
{
  cdr_in_t in = rclc_parameter_request_begin(server);
  const uint32_t count = rclc_parameter_in_length(&in);
  size_t created = 0; /* parameters that do not exist yet */
  parameter_outcome_t outcome = PARAMETER_SET;

  for (uint32_t i = 0; i < count && outcome == PARAMETER_SET; ++i) {
    parameter_requested_t requested;
    const rclc_parameter_place_t * found;

    rclc_parameter_request_parameter(&in, &requested);
    found = rclc_parameter_find(server, &requested.name);
    if (pass == SET_PASS_CHECK) {
      if (found == NULL && !set_has_name(server, i, &requested.name)) {
        ++created;
      }
      outcome = set_check_parameter(server, found, &requested, created);
    } else if (pass == SET_PASS_ACCEPT) {
      outcome = set_accepts(server, found, &requested) ? PARAMETER_SET : PARAMETER_REJECTED;
    } else {
      set_make_in_pass(server, found, &requested, pass);
    }
    server->outcomes[i] = (uint8_t)outcome;
  }
  return outcome == PARAMETER_SET;
}

void rclc_parameter_set_all(rclc_parameter_server_t * server)
{
  if (set_pass(server, SET_PASS_CHECK) && set_pass(server, SET_PASS_ACCEPT)) {
    (void)set_pass(server, SET_PASS_MAKE);
    (void)set_pass(server, SET_PASS_DELETE);
    rclc_parameter_publish(server);
  }
}
