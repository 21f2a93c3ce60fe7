/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_client.h"
#include "microros/rclc_parameter_in.h"

#include <stddef.h>

rcl_ret_t rclc_parameter_client_list_async(
  rclc_parameter_client_t * client, const char * const * prefixes, size_t count, uint64_t depth,
  uint32_t timeout_ms, rclc_parameter_client_callback_t callback, void * context)
{
  const rcl_ret_t result = rclc_parameter_client_check_names(client, prefixes, count);

  if (result != RCL_RET_OK) {
    return result;
  }
  client->depth = depth;
  return rclc_parameter_client_send(
    client, (uint8_t)RCLC_PARAMETER_CLIENT_LIST, prefixes, count, timeout_ms, callback, context);
}

rcl_ret_t rclc_parameter_client_list(
  rclc_parameter_client_t * client, const char * const * prefixes, size_t count, uint64_t depth,
  uint32_t timeout_ms)
{
  const rcl_ret_t result = rclc_parameter_client_check_names(client, prefixes, count);

  if (result != RCL_RET_OK) {
    return result;
  }
  client->depth = depth;
  return rclc_parameter_client_send_and_wait(
    client, (uint8_t)RCLC_PARAMETER_CLIENT_LIST, prefixes, count, timeout_ms);
}

const char * rclc_parameter_client_name(rclc_parameter_client_t * client, size_t index)
{
  const char * name = NULL;
  cdr_fault_t fault;
  cdr_in_t in;

  if (index >= rclc_parameter_client_count(client) || client->call != (uint8_t)RCLC_PARAMETER_CLIENT_LIST) {
    return NULL;
  }
  in = rclc_parameter_client_begin(client, &fault);
  (void)rclc_parameter_in_length(&in);
  for (size_t i = 0; i <= index; ++i) {
    name = rclc_parameter_client_read_text(&in);
  }
  return name;
}
