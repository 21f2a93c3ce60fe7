/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rclc_parameter_client.h"

#include <stddef.h>

rcl_ret_t rclc_parameter_client_set_async(
  rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count,
  uint32_t timeout_ms, rclc_parameter_client_callback_t callback, void * context)
{
  const rcl_ret_t result = rclc_parameter_client_check_parameters(client, parameters, count);

  return result != RCL_RET_OK
           ? result
           : rclc_parameter_client_send(
               client, (uint8_t)RCLC_PARAMETER_CLIENT_SET, parameters, count, timeout_ms, callback, context);
}

rcl_ret_t rclc_parameter_client_set(
  rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count,
  uint32_t timeout_ms)
{
  const rcl_ret_t result = rclc_parameter_client_check_parameters(client, parameters, count);

  return result != RCL_RET_OK ? result
                              : rclc_parameter_client_send_and_wait(
                                  client, (uint8_t)RCLC_PARAMETER_CLIENT_SET, parameters, count, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_bool(
  rclc_parameter_client_t * client, const char * name, bool value, uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {name, {RCLC_PARAMETER_BOOL, 0, {.bool_value = value}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_int(
  rclc_parameter_client_t * client, const char * name, int64_t value, uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {
    name, {RCLC_PARAMETER_INT, 0, {.integer_value = value}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_double(
  rclc_parameter_client_t * client, const char * name, double value, uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {
    name, {RCLC_PARAMETER_DOUBLE, 0, {.double_value = value}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_string(
  rclc_parameter_client_t * client, const char * name, const char * value, uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {
    name, {RCLC_PARAMETER_STRING, 0, {.string_value = value}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_byte_array(
  rclc_parameter_client_t * client, const char * name, const uint8_t * values, size_t count,
  uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {
    name, {RCLC_PARAMETER_BYTE_ARRAY, count, {.byte_array_value = values}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_bool_array(
  rclc_parameter_client_t * client, const char * name, const bool * values, size_t count, uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {
    name, {RCLC_PARAMETER_BOOL_ARRAY, count, {.bool_array_value = values}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_int_array(
  rclc_parameter_client_t * client, const char * name, const int64_t * values, size_t count,
  uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {
    name, {RCLC_PARAMETER_INT_ARRAY, count, {.integer_array_value = values}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_double_array(
  rclc_parameter_client_t * client, const char * name, const double * values, size_t count,
  uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {
    name, {RCLC_PARAMETER_DOUBLE_ARRAY, count, {.double_array_value = values}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}

rcl_ret_t rclc_parameter_client_set_string_array(
  rclc_parameter_client_t * client, const char * name, const char * const * values, size_t count,
  uint32_t timeout_ms)
{
  const rclc_parameter_client_parameter_t parameter = {
    name, {RCLC_PARAMETER_STRING_ARRAY, count, {.string_array_value = values}}};

  return rclc_parameter_client_set(client, &parameter, 1u, timeout_ms);
}
