/* SPDX-License-Identifier: Apache-2.0 */
/* Calls whose requests are lists of names. */
#include "microros/error.h"
#include "microros/rclc_parameter_client.h"

rcl_ret_t rclc_parameter_client_refuse_name(const rclc_parameter_client_t * client)
{
  return rclc_parameter_client_refuse(
    client, RCLC_PARAMETER_CLIENT_UNKNOWN, MICROROS_ERROR_WORDS("unknown name"));
}

rcl_ret_t rclc_parameter_client_judge_names(rclc_parameter_client_t * client)
{
  return client->count == client->requested ? RCL_RET_OK : rclc_parameter_client_refuse_name(client);
}
