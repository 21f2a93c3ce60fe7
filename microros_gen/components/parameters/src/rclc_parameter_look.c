/* SPDX-License-Identifier: Apache-2.0 */
/* Finds the parameter for a call of the application, or sets the error. */
#include "microros/error.h"
#include "microros/rclc_parameters.h"

#include <stddef.h>

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
  return *result == RCL_RET_OK;
}
