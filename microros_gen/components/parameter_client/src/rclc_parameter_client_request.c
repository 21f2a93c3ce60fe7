/* SPDX-License-Identifier: Apache-2.0 */
/* Requests are written from the caller's arguments, which were checked: a request has room. */
#include "microros/error.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rclc_parameter_out.h"
#include "microros/text.h"

#include <stddef.h>

static rcl_ret_t check_parameter_count(
  const rclc_parameter_client_t * client, const void * items, size_t count)
{
  if (client == NULL || client->remote == NULL || (items == NULL && count != 0u)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client, names or parameters");
  }
  return count <= MICROROS_PARAMETER_CLIENT_PARAMETERS
           ? RCL_RET_OK
           : rclc_parameter_client_refuse_limit(
               client, MICROROS_ERROR_WORDS("parameters"), count, MICROROS_PARAMETER_CLIENT_PARAMETERS);
}

/* Returns the size limit of values of a type; 0 if no client has this type. */
static size_t check_parameter_most(rclc_parameter_type_t type, size_t most)
{
  return ((uint32_t)MICROROS_PARAMETER_CLIENT_TYPES >> (uint32_t)type & 1u) != 0u ? most : 0u;
}

/* Returns the bytes of a text without its NUL; SIZE_MAX, with an error, for NULL. */
static size_t check_parameter_text(const char * text)
{
  if (text == NULL) {
    (void)microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "a name or string");
    return SIZE_MAX;
  }
  return microros_text_size(text);
}

static rcl_ret_t check_parameter_name(const rclc_parameter_client_t * client, const char * name)
{
  const size_t size = check_parameter_text(name);

  if (size == SIZE_MAX) {
    return RCL_RET_INVALID_ARGUMENT;
  }
  return size < (size_t)MICROROS_PARAMETER_CLIENT_NAME_SIZE
           ? RCL_RET_OK
           : rclc_parameter_client_refuse(
               client, RCLC_PARAMETER_CLIENT_LIMIT, MICROROS_ERROR_WORDS("too long a name"));
}

static rcl_ret_t check_parameter_string(
  const rclc_parameter_client_t * client, const char * text, rclc_parameter_type_t type)
{
  const size_t most = check_parameter_most(type, (size_t)MICROROS_PARAMETER_CLIENT_STRING_SIZE - 1u);
  const size_t size = check_parameter_text(text);

  if (size == SIZE_MAX) {
    return RCL_RET_INVALID_ARGUMENT;
  }
  return size <= most
           ? RCL_RET_OK
           : rclc_parameter_client_refuse_limit(client, MICROROS_ERROR_WORDS("string"), size, most);
}

rcl_ret_t rclc_parameter_client_check_names(
  const rclc_parameter_client_t * client, const char * const * names, size_t count)
{
  rcl_ret_t result = check_parameter_count(client, names, count);

  for (size_t i = 0; i < count && result == RCL_RET_OK; ++i) {
    result = check_parameter_name(client, names[i]);
  }
  return result;
}

static rcl_ret_t check_parameter_array(
  const rclc_parameter_client_t * client, const rclc_parameter_client_value_t * value)
{
  const size_t most = check_parameter_most(value->type, MICROROS_PARAMETER_CLIENT_ELEMENTS);
  rcl_ret_t result = RCL_RET_OK;

  if (value->count > most) {
    return rclc_parameter_client_refuse_limit(client, MICROROS_ERROR_WORDS("elements"), value->count, most);
  }
  if (value->count != 0u && value->as.byte_array_value == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "an array");
  }
  if (value->type == RCLC_PARAMETER_STRING_ARRAY) {
    for (size_t i = 0; i < value->count && result == RCL_RET_OK; ++i) {
      result = check_parameter_string(client, value->as.string_array_value[i], value->type);
    }
  }
  return result;
}

static rcl_ret_t check_parameter_value(
  const rclc_parameter_client_t * client, const rclc_parameter_client_value_t * value)
{
  switch (value->type) {
    case RCLC_PARAMETER_NOT_SET:
    case RCLC_PARAMETER_BOOL:
    case RCLC_PARAMETER_INT:
    case RCLC_PARAMETER_DOUBLE:
      return RCL_RET_OK;
    case RCLC_PARAMETER_STRING:
      return check_parameter_string(client, value->as.string_value, value->type);
    case RCLC_PARAMETER_BYTE_ARRAY:
    case RCLC_PARAMETER_BOOL_ARRAY:
    case RCLC_PARAMETER_INT_ARRAY:
    case RCLC_PARAMETER_DOUBLE_ARRAY:
    case RCLC_PARAMETER_STRING_ARRAY:
      return check_parameter_array(client, value);
    default:
      return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "the type of a value");
  }
}

rcl_ret_t rclc_parameter_client_check_parameters(
  const rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count)
{
  rcl_ret_t result = check_parameter_count(client, parameters, count);

  for (size_t i = 0; i < count && result == RCL_RET_OK; ++i) {
    result = check_parameter_name(client, parameters[i].name);
    if (result == RCL_RET_OK) {
      result = check_parameter_value(client, &parameters[i].value);
    }
  }
  return result;
}

/* Returns the size of the request, or 0. */
static uint32_t write_parameters_end(const parameter_out_t * out, cdr_fault_t * fault)
{
  if (out->full) {
    (void)cdr_refuse(fault, CDR_FAULT_LIMIT, "parameters", out->room, out->room);
  }
  return out->full ? 0u : out->position;
}

static void write_parameter_names(parameter_out_t * out, const rclc_parameter_client_t * client)
{
  const char * const * names = client->items;

  rclc_parameter_out_4(out, (uint32_t)client->count);
  for (size_t i = 0; i < client->count; ++i) {
    rclc_parameter_out_text(out, names[i]);
  }
}

uint32_t rclc_parameter_client_write_names(
  const rclc_parameter_client_t * client, uint8_t * body, uint32_t room, cdr_fault_t * fault)
{
  parameter_out_t out = {body, 0, room, false};

  write_parameter_names(&out, client);
  return write_parameters_end(&out, fault);
}

uint32_t rclc_parameter_client_write_prefixes(
  const rclc_parameter_client_t * client, uint8_t * body, uint32_t room, cdr_fault_t * fault)
{
  parameter_out_t out = {body, 0, room, false};

  write_parameter_names(&out, client);
  rclc_parameter_out_8(&out, &client->depth);
  return write_parameters_end(&out, fault);
}

/* Writes the array of a type; an empty one if the value has another type. */
static void write_parameter_array(
  parameter_out_t * out, const rclc_parameter_client_value_t * value, rclc_parameter_type_t type,
  uint32_t width)
{
  const size_t count = value->type == type ? value->count : 0u;

  rclc_parameter_out_4(out, (uint32_t)count);
  for (size_t i = 0; i < count; ++i) {
    const uint8_t * element = &value->as.byte_array_value[i * width];

    if (width == 1u) {
      rclc_parameter_out_1(out, *element);
    } else {
      rclc_parameter_out_8(out, element);
    }
  }
}

static void write_parameter_value(parameter_out_t * out, const rclc_parameter_client_value_t * value)
{
  const bool truth = value->type == RCLC_PARAMETER_BOOL && value->as.bool_value;
  const int64_t integer = value->type == RCLC_PARAMETER_INT ? value->as.integer_value : 0;
  const double number = value->type == RCLC_PARAMETER_DOUBLE ? value->as.double_value : 0.0;
  const size_t strings = value->type == RCLC_PARAMETER_STRING_ARRAY ? value->count : 0u;

  rclc_parameter_out_1(out, (uint8_t)value->type);
  rclc_parameter_out_1(out, truth ? 1u : 0u);
  rclc_parameter_out_8(out, &integer);
  rclc_parameter_out_8(out, &number);
  rclc_parameter_out_text(out, value->type == RCLC_PARAMETER_STRING ? value->as.string_value : "");
  write_parameter_array(out, value, RCLC_PARAMETER_BYTE_ARRAY, 1u);
  write_parameter_array(out, value, RCLC_PARAMETER_BOOL_ARRAY, 1u);
  write_parameter_array(out, value, RCLC_PARAMETER_INT_ARRAY, 8u);
  write_parameter_array(out, value, RCLC_PARAMETER_DOUBLE_ARRAY, 8u);
  rclc_parameter_out_4(out, (uint32_t)strings);
  for (size_t i = 0; i < strings; ++i) {
    rclc_parameter_out_text(out, value->as.string_array_value[i]);
  }
}

uint32_t rclc_parameter_client_write_parameters(
  const rclc_parameter_client_t * client, uint8_t * body, uint32_t room, cdr_fault_t * fault)
{
  const rclc_parameter_client_parameter_t * parameters = client->items;
  parameter_out_t out = {body, 0, room, false};

  rclc_parameter_out_4(&out, (uint32_t)client->count);
  for (size_t i = 0; i < client->count; ++i) {
    rclc_parameter_out_text(&out, parameters[i].name);
    write_parameter_value(&out, &parameters[i].value);
  }
  return write_parameters_end(&out, fault);
}
