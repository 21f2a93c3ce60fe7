/* SPDX-License-Identifier: Apache-2.0 */
/* Descriptions and constraints of parameters. */
#include "microros/error.h"
#include "microros/rclc_parameters.h"
#include "microros/text.h"

#include <string.h>

rcl_ret_t rclc_add_parameter_description(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * parameter_description,
  const char * additional_constraints)
{
  static char texts[PARAMETERS_OWN][2u * MICROROS_PARAMETER_TEXT_SIZE];
  rclc_parameter_place_t * place;
  rclc_parameter_about_t * about;
  rcl_ret_t result;
  uint32_t number = 0;
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
  if (size > MICROROS_PARAMETER_TEXT_SIZE || more > MICROROS_PARAMETER_TEXT_SIZE) {
    return rclc_parameter_refuse(
      RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("too long a description"));
  }
  about = rclc_parameter_own(parameter_server, place, &number, &result);
  if (about != NULL) {
    (void)memcpy(texts[number], parameter_description, size);
    (void)memcpy(&texts[number][size], additional_constraints, more);
    about->texts = texts[number];
  }
  return result;
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

/* Sets the range of a parameter of that type. */
static rcl_ret_t describe_range(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type,
  const rclc_parameter_range_t * range)
{
  static rclc_parameter_range_t ranges[PARAMETERS_OWN];
  rcl_ret_t result;
  uint32_t number = 0;
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(server, name, &result);
  rclc_parameter_about_t * about = NULL;

  if (rclc_parameter_is(place, name, type, &result, RCL_RET_ERROR)) {
    about = rclc_parameter_own(server, place, &number, &result);
  }
  if (about != NULL) {
    ranges[number] = *range;
    about->range = &ranges[number];
  }
  return result;
}

rcl_ret_t rclc_add_parameter_constraint_integer(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t from_value,
  int64_t to_value, uint64_t step)
{
  const rclc_parameter_range_t range = {.integer = {from_value, to_value, step}};

  return describe_range(parameter_server, parameter_name, RCLC_PARAMETER_INT, &range);
}

rcl_ret_t rclc_add_parameter_constraint_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, double from_value, double to_value,
  double step)
{
  const rclc_parameter_range_t range = {.floating_point = {from_value, to_value, step}};
  const rcl_ret_t result = describe_range(parameter_server, parameter_name, RCLC_PARAMETER_DOUBLE, &range);

  if (result == RCL_RET_OK) {
    parameter_server->floating_point_holds = rclc_parameter_floating_point_holds;
  }
  return result;
}
