/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameters.h"

#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_string.h"
#if MICROROS_PARAMETERS_HELD
#include "microros/rclc_parameter_held.h"
#endif
#include "microros/text.h"

#include <stddef.h>
#include <string.h>

parameter_text_t rclc_parameter_text(const char * text)
{
  const parameter_text_t result = {text, (uint32_t)microros_text_size(text)};

  return result;
}

bool rclc_parameter_begins(const char * name, const parameter_text_t * text)
{
  const char * end = &text->data[text->size];
  const char * of_name = name;

  for (const char * at = text->data; at != end; ++at) {
    if (*of_name != *at) {
      return false;
    }
    ++of_name;
  }
  return true;
}

const rclc_parameter_place_t * rclc_parameter_find(
  const rclc_parameter_server_t * server, const parameter_text_t * name)
{
  for (size_t i = 0; i < server->count; ++i) {
    const rclc_parameter_place_t * place = &server->places[i];

    if (
      place->event != (uint8_t)PARAMETER_EVENT_DELETED && rclc_parameter_begins(place->about->name, name) &&
      place->about->name[name->size] == '\0') {
      return place;
    }
  }
  return NULL;
}

/* What every place has: set member by member, which takes a few stores instead of a call of memset. */
enum { PLACE_HEAD = offsetof(rclc_parameter_place_t, event) + 1 };

rclc_parameter_place_t * rclc_parameter_place(
  rclc_parameter_server_t * server, const rclc_parameter_about_t * about, uint8_t type)
{
  static const rclc_parameter_scalar_t nothing = {.integer_value = 0}; /* in all 8 bytes */
  rclc_parameter_place_t * place = &server->places[server->count];

  place->value = nothing;
  place->about = about;
  place->type = type;
  place->read_only = false;
  place->dynamic_typing = false;
  place->event = 0;
  (void)memset(&((uint8_t *)place)[PLACE_HEAD], 0, sizeof(*place) - (size_t)PLACE_HEAD);
  return place;
}

parameter_state_t rclc_parameter_state(rclc_parameter_place_t * place)
{
  parameter_state_t state;

  state.name = place->about->name;
  state.type = place->type;
  state.value = place->value;
  rclc_parameter_string_old(place, &state);
  rclc_parameter_array_old(place, &state);
  return state;
}

void rclc_parameter_note(rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint32_t event)
{
  ++server->revision;
#if MICROROS_PARAMETERS_HELD
  rclc_parameter_held_note(server, place, event);
#else
  if (event != (uint32_t)PARAMETER_EVENT_CHANGED || place->event != (uint8_t)PARAMETER_EVENT_NEW) {
    place->event = (uint8_t)event;
  }
#endif
}

void rclc_parameter_disown(const rclc_parameter_server_t * server, const rclc_parameter_place_t * place)
{
  rclc_parameter_own_t * own = server->own;

  for (size_t i = 0; own != NULL && i < MICROROS_PARAMETERS_MAX; ++i) {
    if (place->about == &own->abouts[i]) {
      own->abouts[i].name = NULL;
    }
  }
}

void rclc_parameter_remove(rclc_parameter_server_t * server, const rclc_parameter_place_t * place)
{
  const size_t last = sizeof(server->places) / sizeof(server->places[0]) - 1u;

  rclc_parameter_disown(server, place);
  --server->count;
  for (size_t i = (size_t)(place - server->places); i < server->count && i < last; ++i) {
    server->places[i] = server->places[i + 1u];
  }
}

/* A string of ROS 2 has a pointer to non-const characters, even in a constant message. */
static char * parameter_shown(const char * text)
{
  union {
    const char * in;
    char * out;
  } pointer;

  pointer.in = text;
  return pointer.out;
}

/* Fills the message for the callback, which is zero; it points to the name of the place. */
static void parameter_present(
  rclc_parameter_server_t * server, const parameter_state_t * state, size_t name_size, Parameter * message,
  uint32_t which)
{
  static char nothing[1]; /* a string of ROS 2 is never NULL */

  message->name.data = parameter_shown(state->name);
  message->name.size = name_size;
  message->name.capacity = name_size + 1u;
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
  const Parameter * shown[2];
  Parameter messages[2];
  size_t name_size;
  bool result;

  if (server->on_modification == NULL) {
    return true;
  }
  name_size =
    microros_text_size((old_state != NULL ? old_state : new_state)->name); /* both are of one place */
  (void)memset(messages, 0, sizeof(messages));
  for (uint32_t i = 0; i < 2u; ++i) {
    const parameter_state_t * state = i == 0u ? old_state : new_state;

    shown[i] = NULL;
    if (state != NULL) {
      parameter_present(server, state, name_size, &messages[i], i);
      shown[i] = &messages[i];
    }
  }
  server->on_callback = true;
  result = server->on_modification(shown[0], shown[1], server->context);
  server->on_callback = false;
  return result;
}
