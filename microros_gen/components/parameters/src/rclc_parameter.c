/* SPDX-License-Identifier: Apache-2.0 */
/* Calls of the application. */
#include "microros/cdr.h"
#include "microros/error.h"
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_string.h"
#include "microros/rclc_parameters.h"
#include "microros/text.h"

#include <stddef.h>
#include <string.h>

rcl_ret_t rclc_parameter_refuse(rcl_ret_t result, const char * name, const char * why)
{
  microros_error_set(microros_error_parameter, name, why, 0, 0);
  return result;
}

rcl_ret_t rclc_parameter_refuse_argument(void)
{
  return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "parameter_server or another argument");
}

rclc_parameter_place_t * rclc_parameter_look(
  rclc_parameter_server_t * server, const char * name, rcl_ret_t * result)
{
  const rclc_parameter_place_t * found;
  parameter_text_t text;

  if (server == NULL || name == NULL) {
    *result = rclc_parameter_refuse_argument();
    return NULL;
  }
  text = rclc_parameter_text(name);
  found = rclc_parameter_find(server, &text);
  if (found == NULL) {
    *result = rclc_parameter_refuse(RCL_RET_ERROR, name, MICROROS_ERROR_WORDS("unknown"));
    return NULL;
  }
  *result = RCL_RET_OK;
  return &server->places[found - server->places];
}

static rcl_ret_t look_refuse_callback(const char * name)
{
  return rclc_parameter_refuse(
    RCLC_PARAMETER_DISABLED_ON_CALLBACK, name, MICROROS_ERROR_WORDS("not to be changed by the callback"));
}

rclc_parameter_place_t * rclc_parameter_look_to_change(
  rclc_parameter_server_t * server, const char * name, rcl_ret_t * result)
{
  if (server != NULL && server->on_callback) {
    *result = look_refuse_callback(name);
    return NULL;
  }
  return rclc_parameter_look(server, name, result);
}

static bool look_finds(const rclc_parameter_server_t * server, const char * name)
{
  const parameter_text_t text = rclc_parameter_text(name);

  return rclc_parameter_find(server, &text) != NULL;
}

bool rclc_parameter_may_add(
  const rclc_parameter_server_t * server, const char * name, size_t others, rcl_ret_t * result)
{
  if (server->on_callback) {
    *result = look_refuse_callback(name);
    return false;
  }
  if (others != 0u && look_finds(server, name)) {
    *result = rclc_parameter_refuse(RCL_RET_ERROR, name, MICROROS_ERROR_WORDS("added already"));
    return false;
  }
  if (server->count == server->max_params) {
    const uint32_t count = (uint32_t)server->count;

    microros_error_set(microros_error_parameters_full, name, NULL, count, count + 1u);
    *result = RCL_RET_ERROR;
    return false;
  }
  return true;
}

bool rclc_parameter_is(
  const rclc_parameter_place_t * place, const char * name, rclc_parameter_type_t type, rcl_ret_t * result,
  rcl_ret_t error)
{
  if (place != NULL && place->type != (uint8_t)type) {
    *result = rclc_parameter_refuse(error, name, MICROROS_ERROR_WORDS("it has another type"));
  }
  return place != NULL && *result == RCL_RET_OK;
}

/* Values are copied from and to messages as they are. */
CDR_STATIC_ASSERT(rclc_parameter_assert_double_has_8_bytes, sizeof(double) == 8U);

rcl_ret_t rclc_add_parameter(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, rclc_parameter_type_t type)
{
  parameter_text_t name;
  rclc_parameter_place_t * place;
  rcl_ret_t result;

  if (parameter_server == NULL || parameter_name == NULL) {
    return rclc_parameter_refuse_argument();
  }
  name = rclc_parameter_text(parameter_name);
  if (name.size == 0u || name.size >= (uint32_t)MICROROS_PARAMETER_NAME_SIZE) {
    return rclc_parameter_refuse(
      RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("empty or too long a name"));
  }
  if (!rclc_parameter_holds((uint32_t)type)) {
    return rclc_parameter_refuse(RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("no type of a value"));
  }
  if (!rclc_parameter_may_add(parameter_server, name.data, parameter_server->count, &result)) {
    return result;
  }
  place = rclc_parameter_create(parameter_server, &name, (uint8_t)type);
  if (place == NULL) {
    return rclc_parameter_refuse(
      RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("more servers than nodes"));
  }
  rclc_parameter_note(parameter_server, place, PARAMETER_EVENT_NEW);
  ++parameter_server->count;
  rclc_parameter_publish(parameter_server);
  return RCL_RET_OK;
}

rcl_ret_t rclc_delete_parameter(rclc_parameter_server_t * parameter_server, const char * parameter_name)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);

  if (place != NULL) {
    rclc_parameter_note(parameter_server, place, PARAMETER_EVENT_DELETED);
    rclc_parameter_publish(parameter_server);
  }
  return result;
}

static rcl_ret_t parameter_set(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type,
  const rclc_parameter_scalar_t * value)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(server, name, &result);
  parameter_state_t old_state;
  parameter_state_t new_state;

  if (!rclc_parameter_is(place, name, type, &result, RCLC_PARAMETER_TYPE_MISMATCH)) {
    return result;
  }
  old_state = rclc_parameter_state(place);
  new_state = old_state;
  new_state.value = *value;
  if (!rclc_parameter_accepts(server, &old_state, &new_state)) {
    return rclc_parameter_refuse(
      RCLC_PARAMETER_MODIFICATION_REJECTED, name, MICROROS_ERROR_WORDS("the callback refused the value"));
  }
  place->value = *value;
  rclc_parameter_note(server, place, PARAMETER_EVENT_CHANGED);
  rclc_parameter_publish(server);
  return RCL_RET_OK;
}

rcl_ret_t rclc_parameter_set_bool(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, bool value)
{
  const rclc_parameter_scalar_t scalar = {.bool_value = value};

  return parameter_set(parameter_server, parameter_name, RCLC_PARAMETER_BOOL, &scalar);
}

rcl_ret_t rclc_parameter_set_int(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t value)
{
  const rclc_parameter_scalar_t scalar = {.integer_value = value};

  return parameter_set(parameter_server, parameter_name, RCLC_PARAMETER_INT, &scalar);
}

rcl_ret_t rclc_parameter_set_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, double value)
{
  const rclc_parameter_scalar_t scalar = {.double_value = value};

  return parameter_set(parameter_server, parameter_name, RCLC_PARAMETER_DOUBLE, &scalar);
}

/* Returns the value of a parameter of that type. */
static rcl_ret_t parameter_get(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type, const void * output,
  rclc_parameter_scalar_t * value)
{
  const rclc_parameter_place_t * place;
  rcl_ret_t result;

  if (output == NULL) {
    return rclc_parameter_refuse_argument();
  }
  place = rclc_parameter_look(server, name, &result);
  if (rclc_parameter_is(place, name, type, &result, RCL_RET_INVALID_ARGUMENT)) {
    *value = place->value;
  }
  return result;
}

rcl_ret_t rclc_parameter_get_bool(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, bool * output)
{
  rclc_parameter_scalar_t value = {.integer_value = 0};
  const rcl_ret_t result =
    parameter_get(parameter_server, parameter_name, RCLC_PARAMETER_BOOL, output, &value);

  if (result == RCL_RET_OK) {
    *output = value.bool_value;
  }
  return result;
}

rcl_ret_t rclc_parameter_get_int(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t * output)
{
  rclc_parameter_scalar_t value = {.integer_value = 0};
  const rcl_ret_t result =
    parameter_get(parameter_server, parameter_name, RCLC_PARAMETER_INT, output, &value);

  if (result == RCL_RET_OK) {
    *output = value.integer_value;
  }
  return result;
}

rcl_ret_t rclc_parameter_get_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, double * output)
{
  rclc_parameter_scalar_t value = {.integer_value = 0};
  const rcl_ret_t result =
    parameter_get(parameter_server, parameter_name, RCLC_PARAMETER_DOUBLE, output, &value);

  if (result == RCL_RET_OK) {
    *output = value.double_value;
  }
  return result;
}

#if MICROROS_PARAMETER_STRING_SIZE > 0u
rcl_ret_t rclc_parameter_set_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * value)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place;
  parameter_state_t old_state;
  parameter_state_t new_state;
  parameter_text_t text = {value, 0};

  if (value == NULL) {
    return rclc_parameter_refuse_argument();
  }
  place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);
  if (!rclc_parameter_is(
        place, parameter_name, RCLC_PARAMETER_STRING, &result, RCLC_PARAMETER_TYPE_MISMATCH)) {
    return result;
  }
  text.size = (uint32_t)microros_text_size(value);
  if (text.size > place->about->string_most) {
    return rclc_parameter_refuse(
      RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("the string is too long: raise its size"));
  }
  rclc_parameter_string_copy(parameter_server->string_new, &text);
  old_state = rclc_parameter_state(place);
  new_state = old_state;
  new_state.string = parameter_server->string_new;
  if (!rclc_parameter_accepts(parameter_server, &old_state, &new_state)) {
    return rclc_parameter_refuse(
      RCLC_PARAMETER_MODIFICATION_REJECTED, parameter_name,
      MICROROS_ERROR_WORDS("the callback refused the value"));
  }
  rclc_parameter_string_copy(place->string, &text);
  rclc_parameter_note(parameter_server, place, PARAMETER_EVENT_CHANGED);
  rclc_parameter_publish(parameter_server);
  return RCL_RET_OK;
}

rcl_ret_t rclc_parameter_get_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char ** output)
{
  rcl_ret_t result;
  const rclc_parameter_place_t * place;

  if (output == NULL) {
    return rclc_parameter_refuse_argument();
  }
  place = rclc_parameter_look(parameter_server, parameter_name, &result);
  if (rclc_parameter_is(place, parameter_name, RCLC_PARAMETER_STRING, &result, RCL_RET_INVALID_ARGUMENT)) {
    *output = place->string;
  }
  return result;
}

rcl_ret_t rclc_add_parameter_constraint_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, size_t size)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place;
  rclc_parameter_about_t * about;
  uint32_t number = 0;

  if (size >= MICROROS_PARAMETER_STRING_SIZE) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "size");
  }
  place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);
  if (!rclc_parameter_is(place, parameter_name, RCLC_PARAMETER_STRING, &result, RCL_RET_ERROR)) {
    return result;
  }
  if (microros_text_size(place->string) > size) {
    return rclc_parameter_refuse(RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("its string is longer"));
  }
  about = rclc_parameter_own(parameter_server, place, &number, &result);
  if (about != NULL) {
    about->string_most = (uint32_t)size;
  }
  return result;
}
#endif
