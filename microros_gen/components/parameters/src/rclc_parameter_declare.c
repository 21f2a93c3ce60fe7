/* SPDX-License-Identifier: Apache-2.0 */
/* The declared parameters: declared with their default values, and copied to the struct of the application. */
#include "microros/rclc_parameter_declared.h"

#include "microros/error.h"
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_copy.h"
#include "microros/rclc_parameter_string.h"
#include "microros/rclc_parameters.h"
#include "microros/text.h"

#include <string.h>

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

/* Returns the place of a parameter of that type, or NULL. */
static const rclc_parameter_place_t * copy_find(
  const rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type)
{
  const parameter_text_t text = rclc_parameter_text(name);
  const rclc_parameter_place_t * place = rclc_parameter_find(server, &text);

  return place != NULL && place->type == (uint8_t)type ? place : NULL;
}

void rclc_parameter_copy_bool(const rclc_parameter_server_t * server, const char * name, bool * to)
{
  const rclc_parameter_place_t * place = copy_find(server, name, RCLC_PARAMETER_BOOL);

  if (place != NULL) {
    *to = place->value.bool_value;
  }
}

void rclc_parameter_copy_integer(const rclc_parameter_server_t * server, const char * name, int64_t * to)
{
  const rclc_parameter_place_t * place = copy_find(server, name, RCLC_PARAMETER_INT);

  if (place != NULL) {
    *to = place->value.integer_value;
  }
}

void rclc_parameter_copy_double(const rclc_parameter_server_t * server, const char * name, double * to)
{
  const rclc_parameter_place_t * place = copy_find(server, name, RCLC_PARAMETER_DOUBLE);

  if (place != NULL) {
    *to = place->value.double_value;
  }
}

#if MICROROS_PARAMETER_STRING_SIZE > 0u
void rclc_parameter_copy_string(
  const rclc_parameter_server_t * server, const char * name, char * to, size_t room)
{
  const rclc_parameter_place_t * place = copy_find(server, name, RCLC_PARAMETER_STRING);

  if (place != NULL && microros_text_size(place->string) < room) {
    (void)memcpy(to, place->string, microros_text_size(place->string) + 1u);
  }
}
#endif

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
void rclc_parameter_copy_array(
  const rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type, void * to,
  size_t room, size_t * count)
{
  const bool is_wide = type == RCLC_PARAMETER_INT_ARRAY || type == RCLC_PARAMETER_DOUBLE_ARRAY;
  const size_t width = is_wide ? sizeof(int64_t) : 1u;
  const rclc_parameter_place_t * place = copy_find(server, name, type);

  if (place != NULL && place->array_count <= room) {
    (void)memcpy(to, &place->array, place->array_count * width);
    *count = place->array_count;
  }
}
#endif

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
void rclc_parameter_copy_strings(
  const rclc_parameter_server_t * server, const char * name, char (*to)[MICROROS_PARAMETER_ARRAY_STRING_SIZE],
  size_t room, size_t * count)
{
  const rclc_parameter_place_t * place = copy_find(server, name, RCLC_PARAMETER_STRING_ARRAY);
  size_t position = 0;

  if (place == NULL || place->array_count > room) {
    return;
  }
  for (size_t i = 0; i < place->array_count; ++i) {
    const size_t size = microros_text_size(&place->array.texts[position]) + 1u;

    (void)memcpy(to[i], &place->array.texts[position], size);
    position += size;
  }
  *count = place->array_count;
}
#endif
