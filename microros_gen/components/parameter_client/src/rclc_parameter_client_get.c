/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rclc_parameter_in.h"

#include <stddef.h>

rcl_ret_t rclc_parameter_client_get_async(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context)
{
  const rcl_ret_t result = rclc_parameter_client_check_names(client, names, count);

  return result != RCL_RET_OK
           ? result
           : rclc_parameter_client_send(
               client, (uint8_t)RCLC_PARAMETER_CLIENT_GET, names, count, timeout_ms, callback, context);
}

rcl_ret_t rclc_parameter_client_get(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms)
{
  const rcl_ret_t result = rclc_parameter_client_check_names(client, names, count);

  return result != RCL_RET_OK ? result
                              : rclc_parameter_client_send_and_wait(
                                  client, (uint8_t)RCLC_PARAMETER_CLIENT_GET, names, count, timeout_ms);
}

rcl_ret_t rclc_parameter_client_value(
  rclc_parameter_client_t * client, size_t index, rclc_parameter_client_value_t * value)
{
  cdr_fault_t fault;
  cdr_in_t in;

  if (
    value == NULL || index >= rclc_parameter_client_count(client) ||
    client->call != (uint8_t)RCLC_PARAMETER_CLIENT_GET) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client, index or value");
  }
  in = rclc_parameter_client_begin(client, &fault);
  (void)rclc_parameter_in_length(&in);
  for (size_t i = 0; i <= index; ++i) {
    rclc_parameter_client_read_value(client, &in, value);
  }
  return value->type != RCLC_PARAMETER_NOT_SET ? RCL_RET_OK : rclc_parameter_client_refuse_name(client);
}

/* Gets one value of a type and waits for it. */
static rcl_ret_t get_parameter(
  rclc_parameter_client_t * client, const char * name, rclc_parameter_type_t type,
  rclc_parameter_client_value_t * value, uint32_t timeout_ms)
{
  static const rclc_parameter_client_value_t nothing = {.type = RCLC_PARAMETER_NOT_SET};
  rcl_ret_t result = rclc_parameter_client_get(client, &name, 1u, timeout_ms);

  *value = nothing; /* unchanged if the value is refused */
  if (result == RCL_RET_OK) {
    result = rclc_parameter_client_value(client, 0u, value);
  }
  if (result == RCL_RET_OK && value->type != type) {
    result = rclc_parameter_client_refuse(
      client, RCLC_PARAMETER_TYPE_MISMATCH, MICROROS_ERROR_WORDS("a parameter of another type"));
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_bool(
  rclc_parameter_client_t * client, const char * name, bool * output, uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_BOOL, &value, timeout_ms);
  if (result == RCL_RET_OK) {
    *output = value.as.bool_value;
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_int(
  rclc_parameter_client_t * client, const char * name, int64_t * output, uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_INT, &value, timeout_ms);
  if (result == RCL_RET_OK) {
    *output = value.as.integer_value;
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_double(
  rclc_parameter_client_t * client, const char * name, double * output, uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_DOUBLE, &value, timeout_ms);
  if (result == RCL_RET_OK) {
    *output = value.as.double_value;
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_string(
  rclc_parameter_client_t * client, const char * name, const char ** output, uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_STRING, &value, timeout_ms);
  if (result == RCL_RET_OK) {
    *output = value.as.string_value;
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_byte_array(
  rclc_parameter_client_t * client, const char * name, const uint8_t ** output, size_t * count,
  uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL || count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output or count");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_BYTE_ARRAY, &value, timeout_ms);
  if (result == RCL_RET_OK) {
    *output = value.as.byte_array_value;
    *count = value.count;
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_bool_array(
  rclc_parameter_client_t * client, const char * name, const bool ** output, size_t * count,
  uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL || count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output or count");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_BOOL_ARRAY, &value, timeout_ms);
  if (result == RCL_RET_OK) {
    *output = value.as.bool_array_value;
    *count = value.count;
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_int_array(
  rclc_parameter_client_t * client, const char * name, const int64_t ** output, size_t * count,
  uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL || count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output or count");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_INT_ARRAY, &value, timeout_ms);
  if (result == RCL_RET_OK) {
    *output = value.as.integer_array_value;
    *count = value.count;
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_double_array(
  rclc_parameter_client_t * client, const char * name, const double ** output, size_t * count,
  uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL || count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output or count");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_DOUBLE_ARRAY, &value, timeout_ms);
  if (result == RCL_RET_OK) {
    *output = value.as.double_array_value;
    *count = value.count;
  }
  return result;
}

rcl_ret_t rclc_parameter_client_get_string_array(
  rclc_parameter_client_t * client, const char * name, const char ** output, size_t capacity, size_t * count,
  uint32_t timeout_ms)
{
  rclc_parameter_client_value_t value;
  rcl_ret_t result;

  if (output == NULL || count == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output or count");
  }
  result = get_parameter(client, name, RCLC_PARAMETER_STRING_ARRAY, &value, timeout_ms);
  if (result == RCL_RET_OK && value.count > capacity) {
    result = rclc_parameter_client_refuse(
      client, RCLC_PARAMETER_CLIENT_LIMIT, MICROROS_ERROR_WORDS("an array above your capacity"));
  }
  if (result == RCL_RET_OK) {
    *count = value.count;
    for (size_t i = 0; i < value.count; ++i) {
      output[i] = value.as.string_array_value[i];
    }
  }
  return result;
}
