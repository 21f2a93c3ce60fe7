/* SPDX-License-Identifier: Apache-2.0 */
/* What ROS 2 shows of a parameter besides its value, and what it accepts. */
#include "microros/error.h"
#include "microros/rclc_parameters.h"
#include "microros/text.h"

#include <float.h>
#include <string.h>

static rcl_ret_t describe_refuse(const char * name, const char * why)
{
  microros_error_set(microros_error_parameter, name, why, 0, 0);
  return RCL_RET_ERROR;
}

/* Returns the place of a parameter that is to be described; NULL: *result says why. */
static rclc_parameter_place_t * describe_look(
  rclc_parameter_server_t * server, const char * name, rcl_ret_t * result)
{
  const rclc_parameter_place_t * found;
  parameter_text_t text = {name, 0};

  if (server == NULL || name == NULL) {
    *result = microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "parameter_server or parameter_name");
    return NULL;
  }
  if (server->on_callback) {
    (void)describe_refuse(name, MICROROS_ERROR_WORDS("not to be changed by the callback"));
    *result = RCLC_PARAMETER_DISABLED_ON_CALLBACK;
    return NULL;
  }
  text.size = (uint32_t)microros_text_size(name);
  found = rclc_parameter_find(server, &text);
  if (found == NULL) {
    *result = describe_refuse(name, MICROROS_ERROR_WORDS("unknown"));
    return NULL;
  }
  *result = RCL_RET_OK;
  return &server->places[found - server->places];
}

rcl_ret_t rclc_add_parameter_description(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * parameter_description,
  const char * additional_constraints)
{
  rclc_parameter_place_t * place;
  rcl_ret_t result;
  size_t size;
  size_t more;

  if (parameter_description == NULL || additional_constraints == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "parameter_description or additional_constraints");
  }
  place = describe_look(parameter_server, parameter_name, &result);
  if (place == NULL) {
    return result;
  }
  if (parameter_server->low_mem_mode) {
    (void)describe_refuse(parameter_name, MICROROS_ERROR_WORDS("no descriptions in low-memory mode"));
    return RCLC_PARAMETER_UNSUPORTED_ON_LOW_MEM;
  }
  size = microros_text_size(parameter_description) + 1u;
  more = microros_text_size(additional_constraints) + 1u;
  if (size > sizeof(place->description) || more > sizeof(place->additional_constraints)) {
    return describe_refuse(parameter_name, MICROROS_ERROR_WORDS("too long a description"));
  }
  (void)memcpy(place->description, parameter_description, size);
  (void)memcpy(place->additional_constraints, additional_constraints, more);
  return RCL_RET_OK;
}

rcl_ret_t rclc_set_parameter_read_only(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, bool read_only)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place = describe_look(parameter_server, parameter_name, &result);

  if (place != NULL) {
    place->read_only = read_only;
  }
  return result;
}

/* Returns the place of a parameter of that type; NULL: *result says why. */
static rclc_parameter_place_t * describe_look_typed(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type, rcl_ret_t * result)
{
  rclc_parameter_place_t * place = describe_look(server, name, result);

  if (place != NULL && place->type != (uint8_t)type) {
    *result = describe_refuse(name, MICROROS_ERROR_WORDS("it has another type"));
    return NULL;
  }
  return place;
}

rcl_ret_t rclc_add_parameter_constraint_integer(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t from_value,
  int64_t to_value, uint64_t step)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place =
    describe_look_typed(parameter_server, parameter_name, RCLC_PARAMETER_INT, &result);

  if (place != NULL) {
    place->has_range = true;
    place->range.integer.from_value = from_value;
    place->range.integer.to_value = to_value;
    place->range.integer.step = step;
  }
  return result;
}

static double describe_magnitude(double value)
{
  return value < 0.0 ? -value : value;
}

/* As rclcpp compares: 100 times the precision of the two together. */
static bool describe_equals(double a, double b)
{
  return describe_magnitude(a - b) <= DBL_EPSILON * describe_magnitude(a + b) * 100.0;
}

/* Only linked where a parameter has such a range: a processor without a double unit needs a lot of code for it. */
static bool describe_holds(const rclc_parameter_range_t * range, double value)
{
  const double whole_numbers = 9007199254740992.0; /* 2^53: from here on a double has no fraction */
  const double from = range->floating_point.from_value;
  const double step = range->floating_point.step;
  double steps;

  if (describe_equals(value, from) || describe_equals(value, range->floating_point.to_value)) {
    return true;
  }
  if (value < from || value > range->floating_point.to_value) {
    return false;
  }
  if (!(step > 0.0 || step < 0.0)) {
    return true;
  }
  steps = describe_magnitude((value - from) / step);
  if (steps < whole_numbers) {
    steps = (double)(int64_t)(steps + 0.5);
  }
  return describe_equals(value, from + steps * describe_magnitude(step));
}

rcl_ret_t rclc_add_parameter_constraint_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, double from_value, double to_value,
  double step)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place =
    describe_look_typed(parameter_server, parameter_name, RCLC_PARAMETER_DOUBLE, &result);

  if (place != NULL) {
    place->has_range = true;
    place->range.floating_point.from_value = from_value;
    place->range.floating_point.to_value = to_value;
    place->range.floating_point.step = step;
    parameter_server->floating_point_holds = describe_holds;
  }
  return result;
}
