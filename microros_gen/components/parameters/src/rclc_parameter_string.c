/* SPDX-License-Identifier: Apache-2.0 */
/* Parameters that are strings, as the application sets and gets them. */
#include "microros/error.h"
#include "microros/rclc_parameter_string.h"
#include "microros/rclc_parameters.h"
#include "microros/text.h"

/* Notes an error where a place is no string. */
static bool string_is(
  const rclc_parameter_place_t * place, const char * name, rcl_ret_t * result, rcl_ret_t error)
{
  if (place != NULL && place->type != (uint8_t)RCLC_PARAMETER_STRING) {
    *result = rclc_parameter_refuse(error, name, MICROROS_ERROR_WORDS("it has another type"));
  }
  return *result == RCL_RET_OK;
}

static rcl_ret_t string_refuse_argument(void)
{
  return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "parameter_server or another argument");
}

rcl_ret_t rclc_parameter_set_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * value)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place;
  parameter_state_t old_state;
  parameter_state_t new_state;
  parameter_text_t text = {value, 0};

  if (value == NULL) {
    return string_refuse_argument();
  }
  place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);
  if (place == NULL || !string_is(place, parameter_name, &result, RCLC_PARAMETER_TYPE_MISMATCH)) {
    return result;
  }
  text.size = (uint32_t)microros_text_size(value);
  if (text.size > place->string_most) {
    return rclc_parameter_refuse(
      RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("the string is too long"));
  }
  rclc_parameter_string_copy(parameter_server->string_new, &text);
  old_state.name = place->name;
  old_state.type = place->type;
  old_state.value = place->value;
  old_state.string = place->string;
  new_state = old_state;
  new_state.string = parameter_server->string_new;
  if (!rclc_parameter_accepts(parameter_server, &old_state, &new_state)) {
    return rclc_parameter_refuse(
      RCLC_PARAMETER_MODIFICATION_REJECTED, parameter_name,
      MICROROS_ERROR_WORDS("the callback refused the value"));
  }
  rclc_parameter_string_copy(place->string, &text);
  place->event = (uint8_t)PARAMETER_EVENT_CHANGED;
  rclc_parameter_publish(parameter_server);
  return RCL_RET_OK;
}

rcl_ret_t rclc_parameter_get_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char ** output)
{
  rcl_ret_t result;
  const rclc_parameter_place_t * place;

  if (output == NULL) {
    return string_refuse_argument();
  }
  place = rclc_parameter_look(parameter_server, parameter_name, &result);
  if (place != NULL && string_is(place, parameter_name, &result, RCL_RET_INVALID_ARGUMENT)) {
    *output = place->string;
  }
  return result;
}

rcl_ret_t rclc_add_parameter_constraint_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, size_t size)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place;

  if (size >= MICROROS_PARAMETER_STRING_SIZE) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "size");
  }
  place = rclc_parameter_look(parameter_server, parameter_name, &result);
  if (place == NULL || !string_is(place, parameter_name, &result, RCL_RET_ERROR)) {
    return result;
  }
  if (microros_text_size(place->string) > size) {
    return rclc_parameter_refuse(RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("its string is longer"));
  }
  place->string_most = (uint32_t)size;
  return RCL_RET_OK;
}
