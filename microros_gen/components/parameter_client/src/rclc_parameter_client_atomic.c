/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_client.h"

rcl_ret_t rclc_parameter_client_set_atomically_async(
  rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count,
  uint32_t timeout_ms, rclc_parameter_client_callback_t callback, void * context)
{
  const rcl_ret_t result = rclc_parameter_client_check_parameters(client, parameters, count);

  return result != RCL_RET_OK ? result
                              : rclc_parameter_client_send(
                                  client, (uint8_t)RCLC_PARAMETER_CLIENT_SET_ATOMICALLY, parameters, count,
                                  timeout_ms, callback, context);
}

rcl_ret_t rclc_parameter_client_set_atomically(
  rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count,
  uint32_t timeout_ms)
{
  const rcl_ret_t result = rclc_parameter_client_check_parameters(client, parameters, count);

  return result != RCL_RET_OK
           ? result
           : rclc_parameter_client_send_and_wait(
               client, (uint8_t)RCLC_PARAMETER_CLIENT_SET_ATOMICALLY, parameters, count, timeout_ms);
}
