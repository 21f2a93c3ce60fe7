/* SPDX-License-Identifier: Apache-2.0 */
/* Finds the parameter that a call of the application means, or says why not. */
#include "microros/error.h"
#include "microros/rclc_parameters.h"
#include "microros/text.h"

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
  parameter_text_t text = {name, 0};

  if (server == NULL || name == NULL) {
    *result = rclc_parameter_refuse_argument();
    return NULL;
  }
  text.size = (uint32_t)microros_text_size(name);
  found = rclc_parameter_find(server, &text);
  if (found == NULL) {
    *result = rclc_parameter_refuse(RCL_RET_ERROR, name, MICROROS_ERROR_WORDS("unknown"));
    return NULL;
  }
  *result = RCL_RET_OK;
  return &server->places[found - server->places];
}

rclc_parameter_place_t * rclc_parameter_look_to_change(
  rclc_parameter_server_t * server, const char * name, rcl_ret_t * result)
{
  if (server != NULL && server->on_callback) {
    *result = rclc_parameter_refuse(
      RCLC_PARAMETER_DISABLED_ON_CALLBACK, name, MICROROS_ERROR_WORDS("not to be changed by the callback"));
    return NULL;
  }
  return rclc_parameter_look(server, name, result);
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
