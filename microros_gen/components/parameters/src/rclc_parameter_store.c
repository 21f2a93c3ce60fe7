/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameters.h"

#include "microros/rclc_parameter_array.h"
#if MICROROS_PARAMETERS_HELD
#include "microros/rclc_parameter_held.h"
#endif
#include "microros/text.h"

#include <string.h>

const rclc_parameter_place_t * rclc_parameter_find(
  const rclc_parameter_server_t * server, const parameter_text_t * name)
{
  for (size_t i = 0; i < server->count; ++i) {
    const rclc_parameter_place_t * place = &server->places[i];

    if (
      place->event != (uint8_t)PARAMETER_EVENT_DELETED && name->size < sizeof(place->name) &&
      place->name[name->size] == '\0' && memcmp(place->name, name->data, name->size) == 0) {
      return place;
    }
  }
  return NULL;
}

rclc_parameter_place_t * rclc_parameter_place(
  rclc_parameter_server_t * server, const parameter_text_t * name, uint8_t type)
{
  rclc_parameter_place_t * place = &server->places[server->count];

  (void)memset(place, 0, sizeof(*place));
  (void)memcpy(place->name, name->data, name->size);
  place->type = type;
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  place->string_most = MICROROS_PARAMETER_STRING_SIZE - 1u;
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  place->array_most = UINT32_MAX;
#endif
  return place;
}

void rclc_parameter_note(rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint32_t event)
{
  ++server->revision;
#if MICROROS_PARAMETERS_HELD
  rclc_parameter_held_note(server, place, event);
#else
  place->event = (uint8_t)event;
#endif
}

void rclc_parameter_remove(rclc_parameter_server_t * server, const rclc_parameter_place_t * place)
{
  const size_t last = sizeof(server->places) / sizeof(server->places[0]) - 1u;

  --server->count;
  for (size_t i = (size_t)(place - server->places); i < server->count && i < last; ++i) {
    server->places[i] = server->places[i + 1u];
  }
}

/* Makes the message that the callback sees; it points to the name of the place. */
static void parameter_present(
  rclc_parameter_server_t * server, const parameter_state_t * state, Parameter * message, uint32_t which)
{
  static char nothing[1]; /* a string of ROS 2 is never NULL */

  (void)memset(message, 0, sizeof(*message));
  message->name.data = state->name;
  message->name.size = microros_text_size(state->name);
  message->name.capacity = message->name.size + 1u;
  message->value.type = state->type;
  message->value.string_value.data = nothing;
  message->value.string_value.capacity = sizeof(nothing);
  if (state->type == (uint8_t)RCLC_PARAMETER_BOOL) {
    message->value.bool_value = state->value.bool_value;
  } else if (state->type == (uint8_t)RCLC_PARAMETER_INT) {
    message->value.integer_value = state->value.integer_value;
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  } else if (state->type == (uint8_t)RCLC_PARAMETER_STRING) {
    message->value.string_value.data = state->string;
    message->value.string_value.size = microros_text_size(state->string);
    message->value.string_value.capacity = message->value.string_value.size + 1u;
#endif
  } else {
    message->value.double_value = state->value.double_value; /* of an array: 0 */
    rclc_parameter_array_present(server, state, &message->value, which);
  }
}

bool rclc_parameter_accepts(
  rclc_parameter_server_t * server, const parameter_state_t * old_state, const parameter_state_t * new_state)
{
  Parameter old_param;
  Parameter new_param;
  bool result;

  if (server->on_modification == NULL) {
    return true;
  }
  if (old_state != NULL) {
    parameter_present(server, old_state, &old_param, 0u);
  }
  if (new_state != NULL) {
    parameter_present(server, new_state, &new_param, 1u);
  }
  server->on_callback = true;
  result = server->on_modification(
    old_state != NULL ? &old_param : NULL, new_state != NULL ? &new_param : NULL, server->context);
  server->on_callback = false;
  return result;
}
