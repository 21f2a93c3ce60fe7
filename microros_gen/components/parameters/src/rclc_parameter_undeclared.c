/* SPDX-License-Identifier: Apache-2.0 */
/* Set requests that create parameters, where the options of a server allow them. Else none of this is linked. */
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_string.h"
#include "microros/rclc_parameters.h"

static parameter_outcome_t undeclared_check(
  const rclc_parameter_server_t * server, const parameter_requested_t * requested, size_t created)
{
  if (requested->name.size >= (uint32_t)MICROROS_PARAMETER_NAME_SIZE) {
    return PARAMETER_NAME_LONG;
  }
  if (!rclc_parameter_holds(requested->type)) {
    return PARAMETER_UNSUPPORTED;
  }
  if (!rclc_parameter_string_fits(NULL, requested)) {
    return PARAMETER_STRING_LONG;
  }
  if (!rclc_parameter_array_fits(NULL, requested)) {
    return PARAMETER_ARRAY_LONG;
  }
  return server->count + created <= server->max_params ? PARAMETER_SET : PARAMETER_FULL;
}

/* The name is shown from a free place. */
static bool undeclared_accepts(
  rclc_parameter_server_t * server, const parameter_text_t * name, parameter_state_t * new_state)
{
  const rclc_parameter_place_t * place = rclc_parameter_create(server, name, new_state->type);
  bool result = false;

  if (place != NULL) {
    new_state->name = place->about->name;
    result = rclc_parameter_accepts(server, NULL, new_state);
    rclc_parameter_disown(server, place);
  }
  return result;
}

static void undeclared_add(rclc_parameter_server_t * server, const parameter_requested_t * requested)
{
  rclc_parameter_place_t * place = rclc_parameter_create(server, &requested->name, requested->type);

  if (place != NULL) {
    place->dynamic_typing = true;
    rclc_parameter_note(server, place, PARAMETER_EVENT_NEW);
    ++server->count;
  }
}

static void undeclared_retype(rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint8_t type)
{
  uint32_t number = 0;
  rcl_ret_t result = RCL_RET_OK;
  rclc_parameter_about_t * about = rclc_parameter_own(server, place, &number, &result);

  if (about != NULL) {
    rclc_parameter_unconstrain(about);
    place->type = type;
  }
}

const rclc_parameter_undeclared_t rclc_parameter_undeclared = {
  undeclared_check,
  undeclared_accepts,
  undeclared_add,
  undeclared_retype,
  "parameter name '%n' is too long",
  "no place for parameter '%n'"};
