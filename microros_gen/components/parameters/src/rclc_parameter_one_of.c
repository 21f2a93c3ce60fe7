/* SPDX-License-Identifier: Apache-2.0 */
/* Parameters with a list of accepted values. */
#include "microros/rclc_parameter_one_of.h"

#if MICROROS_PARAMETER_ONE_OF

#include "microros/error.h"

#include <string.h>

static bool one_of_integers(const int64_t * values, size_t count, int64_t value)
{
  for (size_t i = 0; i < count; ++i) {
    if (values[i] == value) {
      return true;
    }
  }
  return false;
}

/* Compares exactly: the list and the values of requests are read from the same texts. */
static bool one_of_doubles(const double * values, size_t count, double value)
{
  for (size_t i = 0; i < count; ++i) {
    if (values[i] <= value && values[i] >= value) {
      return true;
    }
  }
  return false;
}

#if MICROROS_PARAMETER_STRING_SIZE > 0u
static bool one_of_strings(const char * const * values, size_t count, const parameter_text_t * value)
{
  for (size_t i = 0; i < count; ++i) {
    if (strncmp(values[i], value->data, value->size) == 0 && values[i][value->size] == '\0') {
      return true;
    }
  }
  return false;
}
#endif

bool rclc_parameter_one_of(const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  const void * values = place->about->one_of;
  const size_t count = place->about->one_of_count;

  if (values == NULL) {
    return true;
  }
  switch (place->type) {
    case RCLC_PARAMETER_INT:
      return one_of_integers(values, count, requested->value.integer_value);
    case RCLC_PARAMETER_DOUBLE:
      return one_of_doubles(values, count, requested->value.double_value);
#if MICROROS_PARAMETER_STRING_SIZE > 0u
    case RCLC_PARAMETER_STRING:
      return one_of_strings(values, count, &requested->string);
#endif
    default:
      return true;
  }
}

static rcl_ret_t one_of_add(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type, const void * values,
  size_t count)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place;
  rclc_parameter_about_t * about = NULL;
  uint32_t number = 0;

  if (values == NULL) {
    return rclc_parameter_refuse_argument();
  }
  place = rclc_parameter_look_to_change(server, name, &result);
  if (rclc_parameter_is(place, name, type, &result, RCL_RET_ERROR)) {
    about = rclc_parameter_own(server, place, &number, &result);
  }
  if (about != NULL) {
    about->one_of = values;
    about->one_of_count = count;
  }
  return result;
}

rcl_ret_t rclc_add_parameter_constraint_one_of_int(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const int64_t * values,
  size_t count)
{
  return one_of_add(parameter_server, parameter_name, RCLC_PARAMETER_INT, values, count);
}

rcl_ret_t rclc_add_parameter_constraint_one_of_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const double * values,
  size_t count)
{
  return one_of_add(parameter_server, parameter_name, RCLC_PARAMETER_DOUBLE, values, count);
}

rcl_ret_t rclc_add_parameter_constraint_one_of_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * const * values,
  size_t count)
{
  return one_of_add(parameter_server, parameter_name, RCLC_PARAMETER_STRING, values, count);
}

#endif
