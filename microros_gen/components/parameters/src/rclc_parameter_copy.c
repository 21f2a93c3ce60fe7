/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_copy.h"

#include "microros/rclc_parameters.h"
#include "microros/text.h"

#include <string.h>

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
