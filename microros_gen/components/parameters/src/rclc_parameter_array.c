/* SPDX-License-Identifier: Apache-2.0 */
/* Arrays in requests, in the store, in replies, and for the callback. */
#include "microros/rclc_parameter_array.h"

#include "microros/cdr.h"
#include "microros/error.h"
#include "microros/text.h"

#include <string.h>

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u

/* Bytes of an element of each array, in the order of their types; a string takes at least those of its length. */
static const uint8_t widths[PARAMETER_ARRAYS] = {1, 1, 8, 8, 4};

void rclc_parameter_array_request(cdr_in_t * in, parameter_requested_t * requested)
{
  requested->array = *in;
  requested->array_count = 0;
  if (rclc_parameter_in_pass_empty(in, (uint32_t)PARAMETER_ARRAYS)) {
    return;
  }
  for (uint32_t i = 0; i < (uint32_t)PARAMETER_ARRAYS; ++i) {
    cdr_in_t start = *in;
    const uint32_t count = i == (uint32_t)PARAMETER_ARRAYS - 1u ? rclc_parameter_in_pass_texts(in)
                                                                : rclc_parameter_in_pass(in, widths[i]);

    if (requested->type == i + (uint32_t)RCLC_PARAMETER_BYTE_ARRAY) {
      (void)cdr_in_length(&start, widths[i], "message");
      requested->array = start;
      requested->array_count = count;
    }
  }
}

static bool array_is(uint8_t type)
{
  return type >= (uint8_t)RCLC_PARAMETER_BYTE_ARRAY && type <= (uint8_t)RCLC_PARAMETER_STRING_ARRAY;
}

/* Returns for how many elements of a type the server has room. */
static uint32_t array_room(uint8_t type)
{
  const uint32_t width = widths[type - (uint8_t)RCLC_PARAMETER_BYTE_ARRAY];

  return type == (uint8_t)RCLC_PARAMETER_STRING_ARRAY ? MICROROS_PARAMETER_STRINGS_MAX
                                                      : MICROROS_PARAMETER_ARRAY_SIZE / width;
}

/* Returns how many elements of a type a place accepts. */
static uint32_t array_most(const rclc_parameter_place_t * place, uint8_t type)
{
  const uint32_t room = array_room(type);

  return place != NULL && place->about->array_most < room ? place->about->array_most : room;
}

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
static bool array_texts_fit(const parameter_requested_t * requested)
{
  cdr_in_t in = requested->array;
  bool result = true;

  for (uint32_t i = 0; i < requested->array_count; ++i) {
    result = rclc_parameter_in_text(&in).size < MICROROS_PARAMETER_ARRAY_STRING_SIZE && result;
  }
  return result;
}

static void array_read_texts(char * to, const parameter_requested_t * requested)
{
  cdr_in_t in = requested->array;
  uint32_t position = 0;

  for (uint32_t i = 0; i < requested->array_count; ++i) {
    const parameter_text_t text = rclc_parameter_in_text(&in);

    (void)memcpy(&to[position], text.data, text.size);
    to[position + text.size] = '\0';
    position += text.size + 1u;
  }
}
#endif

bool rclc_parameter_array_fits(const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  if (!array_is(requested->type)) {
    return true;
  }
  if (requested->array_count > array_most(place, requested->type)) {
    return false;
  }
#if MICROROS_PARAMETER_STRINGS_MAX > 0u
  if (requested->type == (uint8_t)RCLC_PARAMETER_STRING_ARRAY) {
    return array_texts_fit(requested);
  }
#endif
  return true;
}

static void array_read(rclc_parameter_array_t * to, const parameter_requested_t * requested)
{
  cdr_in_t in = requested->array;
  const uint32_t count = requested->array_count;

  switch (requested->type) {
    case RCLC_PARAMETER_BYTE_ARRAY:
      cdr_get_1(&in, to->bytes, count, "message");
      break;
    case RCLC_PARAMETER_BOOL_ARRAY:
      cdr_get_bool(&in, to->bools, count, "message");
      break;
    case RCLC_PARAMETER_INT_ARRAY:
      cdr_get_8(&in, to->integers, count, "message");
      break;
    case RCLC_PARAMETER_DOUBLE_ARRAY:
      cdr_get_8(&in, to->doubles, count, "message");
      break;
#if MICROROS_PARAMETER_STRINGS_MAX > 0u
    case RCLC_PARAMETER_STRING_ARRAY:
      array_read_texts(to->texts, requested);
      break;
#endif
    default:
      break;
  }
}

void rclc_parameter_array_new(
  rclc_parameter_server_t * server, const parameter_requested_t * requested, parameter_state_t * state)
{
  array_read(&server->array_new, requested);
  state->array = &server->array_new;
  state->array_count = requested->array_count;
}

void rclc_parameter_array_old(rclc_parameter_place_t * place, parameter_state_t * state)
{
  state->array = &place->array;
  state->array_count = place->array_count;
}

void rclc_parameter_array_set(rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  array_read(&place->array, requested);
  place->array_count = requested->array_count;
}

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
static void array_present_texts(rosidl_runtime_c__String * strings, char * texts, uint32_t count)
{
  size_t position = 0;

  for (uint32_t i = 0; i < count; ++i) {
    strings[i].data = &texts[position];
    strings[i].size = microros_text_size(&texts[position]);
    strings[i].capacity = strings[i].size + 1u;
    position += strings[i].capacity;
  }
}
#endif

void rclc_parameter_array_present(
  rclc_parameter_server_t * server, const parameter_state_t * state, ParameterValue * value, uint32_t which)
{
  const uint32_t count = state->array_count;

  (void)server;
  (void)which;
  switch (state->type) {
    case RCLC_PARAMETER_BYTE_ARRAY:
      value->byte_array_value.data = state->array->bytes;
      value->byte_array_value.size = count;
      value->byte_array_value.capacity = count;
      break;
    case RCLC_PARAMETER_BOOL_ARRAY:
      value->bool_array_value.data = state->array->bools;
      value->bool_array_value.size = count;
      value->bool_array_value.capacity = count;
      break;
    case RCLC_PARAMETER_INT_ARRAY:
      value->integer_array_value.data = state->array->integers;
      value->integer_array_value.size = count;
      value->integer_array_value.capacity = count;
      break;
    case RCLC_PARAMETER_DOUBLE_ARRAY:
      value->double_array_value.data = state->array->doubles;
      value->double_array_value.size = count;
      value->double_array_value.capacity = count;
      break;
#if MICROROS_PARAMETER_STRINGS_MAX > 0u
    case RCLC_PARAMETER_STRING_ARRAY:
      array_present_texts(server->strings[which], state->array->texts, count);
      value->string_array_value.data = server->strings[which];
      value->string_array_value.size = count;
      value->string_array_value.capacity = count;
      break;
#endif
    default:
      break;
  }
}

static void array_out_texts(parameter_out_t * out, const char * texts, uint32_t count)
{
  size_t position = 0;

  for (uint32_t i = 0; i < count; ++i) {
    rclc_parameter_out_text(out, &texts[position]);
    position += microros_text_size(&texts[position]) + 1u;
  }
}

void rclc_parameter_out_arrays(parameter_out_t * out, const rclc_parameter_place_t * place)
{
  for (uint32_t i = 0; i < (uint32_t)PARAMETER_ARRAYS; ++i) {
    const bool has = place->type == i + (uint32_t)RCLC_PARAMETER_BYTE_ARRAY;
    const uint32_t count = has ? place->array_count : 0u;

    rclc_parameter_out_4(out, count);
    if (count != 0u && i == (uint32_t)PARAMETER_ARRAYS - 1u) {
      array_out_texts(out, place->array.texts, count);
    } else if (count != 0u) {
      rclc_parameter_out_bytes(out, widths[i], place->array.bytes, count * widths[i]);
    } else {
      /* no elements, no padding */
    }
  }
}

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
static bool array_start_fits(const char * texts, uint32_t count)
{
  size_t position = 0;
  bool result = true;

  for (uint32_t i = 0; i < count; ++i) {
    const size_t size = microros_text_size(&texts[position]) + 1u;

    result = size <= MICROROS_PARAMETER_ARRAY_STRING_SIZE && result;
    position += size;
  }
  return result;
}
#endif

bool rclc_parameter_array_start(
  rclc_parameter_server_t * server, const rclc_parameter_declared_t * declared, parameter_state_t * state)
{
  const uint32_t count = declared->start_count;

  if (!array_is(declared->type)) {
    return true;
  }
  if (count > array_room(declared->type) || count > declared->about.array_most) {
    return false;
  }
#if MICROROS_PARAMETER_STRINGS_MAX > 0u
  if (declared->type == (uint8_t)RCLC_PARAMETER_STRING_ARRAY && !array_start_fits(declared->start, count)) {
    return false;
  }
#endif
  (void)memcpy(&server->array_new, declared->start, declared->start_bytes);
  state->array = &server->array_new;
  state->array_count = count;
  return true;
}

void rclc_parameter_array_take(rclc_parameter_place_t * place, const parameter_state_t * state)
{
  if (array_is(state->type)) {
    place->array = *state->array;
    place->array_count = state->array_count;
  }
}

static rcl_ret_t array_change(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_place_t * place, uint32_t count)
{
  const parameter_state_t old_state = rclc_parameter_state(place);
  parameter_state_t new_state = old_state;

  new_state.array = &server->array_new;
  new_state.array_count = count;
  if (!rclc_parameter_accepts(server, &old_state, &new_state)) {
    return rclc_parameter_refuse(
      RCLC_PARAMETER_MODIFICATION_REJECTED, name, MICROROS_ERROR_WORDS("the callback refused the value"));
  }
  rclc_parameter_array_take(place, &new_state);
  rclc_parameter_note(server, place, PARAMETER_EVENT_CHANGED);
  rclc_parameter_publish(server);
  return RCL_RET_OK;
}

/* Returns the place for `count` elements of that type; NULL: *result has the error. */
static rclc_parameter_place_t * array_look_to_set(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type, size_t count,
  rcl_ret_t * result)
{
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(server, name, result);

  if (!rclc_parameter_is(place, name, type, result, RCLC_PARAMETER_TYPE_MISMATCH)) {
    return NULL;
  }
  if (count > array_most(place, (uint8_t)type)) {
    *result = rclc_parameter_refuse(
      RCL_RET_ERROR, name, MICROROS_ERROR_WORDS("the array is too long: raise its size"));
    return NULL;
  }
  return place;
}

static rcl_ret_t array_set(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type, const void * values,
  size_t count)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place;

  if (values == NULL && count != 0u) {
    return rclc_parameter_refuse_argument();
  }
  place = array_look_to_set(server, name, type, count, &result);
  if (place == NULL) {
    return result;
  }
  if (count != 0u) {
    (void)memcpy(
      &server->array_new, values, count * widths[(uint32_t)type - (uint32_t)RCLC_PARAMETER_BYTE_ARRAY]);
  }
  return array_change(server, name, place, (uint32_t)count);
}

rcl_ret_t rclc_parameter_set_byte_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const uint8_t * values,
  size_t count)
{
  return array_set(parameter_server, parameter_name, RCLC_PARAMETER_BYTE_ARRAY, values, count);
}

rcl_ret_t rclc_parameter_set_bool_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const bool * values, size_t count)
{
  return array_set(parameter_server, parameter_name, RCLC_PARAMETER_BOOL_ARRAY, values, count);
}

rcl_ret_t rclc_parameter_set_int_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const int64_t * values,
  size_t count)
{
  return array_set(parameter_server, parameter_name, RCLC_PARAMETER_INT_ARRAY, values, count);
}

rcl_ret_t rclc_parameter_set_double_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const double * values,
  size_t count)
{
  return array_set(parameter_server, parameter_name, RCLC_PARAMETER_DOUBLE_ARRAY, values, count);
}

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
rcl_ret_t rclc_parameter_set_string_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * const * values,
  size_t count)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place;
  size_t position = 0;

  if (values == NULL && count != 0u) {
    return rclc_parameter_refuse_argument();
  }
  place = array_look_to_set(parameter_server, parameter_name, RCLC_PARAMETER_STRING_ARRAY, count, &result);
  if (place == NULL) {
    return result;
  }
  for (size_t i = 0; i < count; ++i) {
    const size_t size = values[i] != NULL ? microros_text_size(values[i]) + 1u : 0u;

    if (size == 0u) {
      return rclc_parameter_refuse_argument();
    }
    if (size > MICROROS_PARAMETER_ARRAY_STRING_SIZE) {
      return rclc_parameter_refuse(
        RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("a string is too long"));
    }
    (void)memcpy(&parameter_server->array_new.texts[position], values[i], size);
    position += size;
  }
  return array_change(parameter_server, parameter_name, place, (uint32_t)count);
}
#endif

/* Returns the array of a parameter of that type. */
static const rclc_parameter_array_t * array_get(
  rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type, bool has_output,
  size_t * count, rcl_ret_t * result)
{
  const rclc_parameter_place_t * place;

  if (!has_output || count == NULL) {
    *result = rclc_parameter_refuse_argument();
    return NULL;
  }
  place = rclc_parameter_look(server, name, result);
  if (!rclc_parameter_is(place, name, type, result, RCL_RET_INVALID_ARGUMENT)) {
    return NULL;
  }
  *count = place->array_count;
  return &place->array;
}

rcl_ret_t rclc_parameter_get_byte_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const uint8_t ** output,
  size_t * count)
{
  rcl_ret_t result;
  const rclc_parameter_array_t * array =
    array_get(parameter_server, parameter_name, RCLC_PARAMETER_BYTE_ARRAY, output != NULL, count, &result);

  if (array != NULL) {
    *output = array->bytes;
  }
  return result;
}

rcl_ret_t rclc_parameter_get_bool_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const bool ** output,
  size_t * count)
{
  rcl_ret_t result;
  const rclc_parameter_array_t * array =
    array_get(parameter_server, parameter_name, RCLC_PARAMETER_BOOL_ARRAY, output != NULL, count, &result);

  if (array != NULL) {
    *output = array->bools;
  }
  return result;
}

rcl_ret_t rclc_parameter_get_int_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const int64_t ** output,
  size_t * count)
{
  rcl_ret_t result;
  const rclc_parameter_array_t * array =
    array_get(parameter_server, parameter_name, RCLC_PARAMETER_INT_ARRAY, output != NULL, count, &result);

  if (array != NULL) {
    *output = array->integers;
  }
  return result;
}

rcl_ret_t rclc_parameter_get_double_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const double ** output,
  size_t * count)
{
  rcl_ret_t result;
  const rclc_parameter_array_t * array =
    array_get(parameter_server, parameter_name, RCLC_PARAMETER_DOUBLE_ARRAY, output != NULL, count, &result);

  if (array != NULL) {
    *output = array->doubles;
  }
  return result;
}

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
rcl_ret_t rclc_parameter_get_string_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char ** output,
  size_t * count)
{
  rcl_ret_t result;
  const rclc_parameter_array_t * array =
    array_get(parameter_server, parameter_name, RCLC_PARAMETER_STRING_ARRAY, output != NULL, count, &result);

  if (array != NULL) {
    *output = array->texts;
  }
  return result;
}
#endif

rcl_ret_t rclc_add_parameter_constraint_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, size_t size)
{
  rcl_ret_t result;
  rclc_parameter_place_t * place = rclc_parameter_look_to_change(parameter_server, parameter_name, &result);
  rclc_parameter_about_t * about;
  uint32_t number = 0;

  if (place == NULL) {
    return result;
  }
  if (!array_is(place->type)) {
    return rclc_parameter_refuse(RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("it has another type"));
  }
  if (size > array_room(place->type)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "size");
  }
  if (size < place->array_count) {
    return rclc_parameter_refuse(RCL_RET_ERROR, parameter_name, MICROROS_ERROR_WORDS("its array is longer"));
  }
  about = rclc_parameter_own(parameter_server, place, &number, &result);
  if (about != NULL) {
    about->array_most = (uint32_t)size;
  }
  return result;
}

#endif
