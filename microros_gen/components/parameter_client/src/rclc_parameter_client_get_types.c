/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rclc_parameter_in.h"

#include <stddef.h>

void rclc_parameter_client_decode_types(cdr_in_t * in, void * client)
{
  cdr_in_t kept = rclc_parameter_client_keep(client, in);
  const uint32_t count = rclc_parameter_in_length(&kept);

  for (uint32_t i = 0; i < count && !kept.failed; ++i) {
    uint8_t type = (uint8_t)RCLC_PARAMETER_NOT_SET;

    cdr_get_1(&kept, &type, 1u, "types");
    if (type > (uint8_t)RCLC_PARAMETER_STRING_ARRAY) {
      cdr_in_refuse(&kept, CDR_FAULT_VALUE, "types", type, (uint32_t)RCLC_PARAMETER_STRING_ARRAY);
    }
  }
  rclc_parameter_client_settle(client, in, &kept, count);
}

rcl_ret_t rclc_parameter_client_get_types_async(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context)
{
  const rcl_ret_t result = rclc_parameter_client_check_names(client, names, count);

  return result != RCL_RET_OK
           ? result
           : rclc_parameter_client_send(
               client, (uint8_t)RCLC_PARAMETER_CLIENT_GET_TYPES, names, count, timeout_ms, callback, context);
}

rcl_ret_t rclc_parameter_client_get_types(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms)
{
  const rcl_ret_t result = rclc_parameter_client_check_names(client, names, count);

  return result != RCL_RET_OK ? result
                              : rclc_parameter_client_send_and_wait(
                                  client, (uint8_t)RCLC_PARAMETER_CLIENT_GET_TYPES, names, count, timeout_ms);
}

rcl_ret_t rclc_parameter_client_type(
  rclc_parameter_client_t * client, size_t index, rclc_parameter_type_t * type)
{
  uint8_t number = (uint8_t)RCLC_PARAMETER_NOT_SET;
  cdr_fault_t fault;
  cdr_in_t in;

  if (
    type == NULL || index >= rclc_parameter_client_count(client) ||
    client->call != (uint8_t)RCLC_PARAMETER_CLIENT_GET_TYPES) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client, index or type");
  }
  in = rclc_parameter_client_begin(client, &fault);
  (void)rclc_parameter_in_length(&in);
  (void)rclc_parameter_in_take(&in, (uint32_t)index, 1u);
  cdr_get_1(&in, &number, 1u, "types");
  *type = (rclc_parameter_type_t)number;
  return *type != RCLC_PARAMETER_NOT_SET ? RCL_RET_OK : rclc_parameter_client_refuse_name(client);
}

rcl_ret_t rclc_parameter_client_get_type(
  rclc_parameter_client_t * client, const char * name, rclc_parameter_type_t * output, uint32_t timeout_ms)
{
  rcl_ret_t result;

  if (output == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "output");
  }
  result = rclc_parameter_client_get_types(client, &name, 1u, timeout_ms);
  return result == RCL_RET_OK ? rclc_parameter_client_type(client, 0u, output) : result;
}
