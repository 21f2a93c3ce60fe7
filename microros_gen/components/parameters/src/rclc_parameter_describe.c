/* SPDX-License-Identifier: Apache-2.0 */
/* What ROS 2 shows of a parameter besides its value, and what it accepts. */
#include "microros/error.h"
#include "microros/rclc_parameters.h"
#include "microros/text.h"

#include <float.h>
#include <string.h>

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
  place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);
  if (place == NULL) {
    return result;
  }
  if (parameter_server->low_mem_mode) {
    return rclc_parameter_refuse(
      RCLC_PARAMETER_UNSUPORTED_ON_LOW_MEM, parameter_name,
      MICROROS_ERROR_WORDS("no descriptions in low-memory mode"));
  }
  size = microros_text_size(parameter_description) + 1u;
  more = microros_text_size(additional_constraints) + 1u;
  if (size > sizeof(place->description) || more > sizeof(place->additional_constraints)) {
    return rclc_parameter_refuse(
      RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("too long a description"));
  }
  (void)memcpy(place->description, parameter_description, size);
  (void)memcpy(place->additional_constraints, additional_constraints, more);
  return RCL_RET_OK;
}

rcl_ret_t rclc_set_parameter_read_only(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, bool read_only)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);

  if (place != NULL) {
    place->read_only = read_only;
  }
  return result;
}

rcl_ret_t rclc_add_parameter_constraint_integer(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t from_value,
  int64_t to_value, uint64_t step)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);

  if (rclc_parameter_is(place, parameter_name, RCLC_PARAMETER_INT, &result, RCL_RET_ERROR)) {
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
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);

  if (rclc_parameter_is(place, parameter_name, RCLC_PARAMETER_DOUBLE, &result, RCL_RET_ERROR)) {
    place->has_range = true;
    place->range.floating_point.from_value = from_value;
    place->range.floating_point.to_value = to_value;
    place->range.floating_point.step = step;
    parameter_server->floating_point_holds = describe_holds;
  }
  return result;
}
