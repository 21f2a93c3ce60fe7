/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_declared.h"

#include "microros/error.h"
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_string.h"

/* Sets the default value of a place, if the callback accepts it. */
static rcl_ret_t declare_value(
  rclc_parameter_server_t * server, rclc_parameter_place_t * place,
  const rclc_parameter_declared_t * declared)
{
  const parameter_state_t old_state = rclc_parameter_state(place);
  parameter_state_t new_state = old_state;

  new_state.value = declared->value;
  if (
    !rclc_parameter_string_start(server, declared, &new_state) ||
    !rclc_parameter_array_start(server, declared, &new_state)) {
    return rclc_parameter_refuse(
      RCL_RET_ERROR, declared->about.name, MICROROS_ERROR_WORDS("too long a value"));
  }
  if (!rclc_parameter_accepts(server, &old_state, &new_state)) {
    return rclc_parameter_refuse(
      RCLC_PARAMETER_MODIFICATION_REJECTED, declared->about.name,
      MICROROS_ERROR_WORDS("the callback refused the value"));
  }
  place->value = new_state.value;
  rclc_parameter_string_take(place, &new_state);
  rclc_parameter_array_take(place, &new_state);
  return RCL_RET_OK;
}

/* Those that are declared have different names; `others` are those of the program. */
static rcl_ret_t declare_one(
  rclc_parameter_server_t * server, const rclc_parameter_declared_t * declared, size_t others)
{
  const char * name = declared->about.name;
  rclc_parameter_place_t * place;
  rcl_ret_t result = RCL_RET_OK;

  if (!rclc_parameter_may_add(server, name, others, &result)) {
    return result;
  }
  if (server->low_mem_mode && declared->about.texts != NULL) {
    return rclc_parameter_refuse(
      RCLC_PARAMETER_UNSUPORTED_ON_LOW_MEM, name, MICROROS_ERROR_WORDS("no descriptions in low-memory mode"));
  }
  place = rclc_parameter_place(server, &declared->about, declared->type);
  place->read_only = declared->read_only;
  rclc_parameter_note(server, place, PARAMETER_EVENT_NEW);
  ++server->count;
  if (declared->has_value) {
    result = declare_value(server, place, declared);
  }
  return result;
}

rcl_ret_t rclc_parameter_declare(
  rclc_parameter_server_t * server, const rclc_parameter_declared_t * declared, size_t count)
{
  rcl_ret_t result = RCL_RET_OK;
  size_t others;

  if (server == NULL) {
    return rclc_parameter_refuse_argument();
  }
  others = server->count;
  for (size_t i = 0; i < count && result == RCL_RET_OK; ++i) {
    result = declare_one(server, &declared[i], others);
  }
  rclc_parameter_publish(server); /* all of them in one event */
  return result;
}
