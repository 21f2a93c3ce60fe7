/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rclc_parameter_in.h"

#include <stddef.h>

static bool parameter_outcome_is_of_set(const rclc_parameter_client_t * client)
{
  return client->call == (uint8_t)RCLC_PARAMETER_CLIENT_SET ||
         client->call == (uint8_t)RCLC_PARAMETER_CLIENT_SET_ATOMICALLY;
}

/* Returns whether parameter `index` was set. */
static bool parameter_outcome_read(const rclc_parameter_client_t * client, size_t index, const char ** reason)
{
  cdr_fault_t fault;
  cdr_in_t in = rclc_parameter_client_begin(client, &fault);
  bool successful = false;

  if (client->call == (uint8_t)RCLC_PARAMETER_CLIENT_SET) {
    (void)rclc_parameter_in_length(&in);
  }
  for (size_t i = 0; i <= index; ++i) {
    cdr_get_bool(&in, &successful, 1u, "successful");
    *reason = rclc_parameter_client_read_text(&in);
  }
  return successful;
}

rcl_ret_t rclc_parameter_client_outcome(rclc_parameter_client_t * client, size_t index, const char ** reason)
{
  const char * words = "";
  bool successful;

  if (index >= rclc_parameter_client_count(client) || !parameter_outcome_is_of_set(client)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client or index");
  }
  successful = parameter_outcome_read(client, index, &words);
  if (reason != NULL) {
    *reason = words;
  }
  return successful
           ? RCL_RET_OK
           : microros_error_named(
               RCLC_PARAMETER_MODIFICATION_REJECTED, microros_error_parameter_client_rejected, words);
}

rcl_ret_t rclc_parameter_client_judge_results(rclc_parameter_client_t * client)
{
  const size_t wanted = client->call == (uint8_t)RCLC_PARAMETER_CLIENT_SET ? client->requested : 1u;

  if (client->count != wanted) {
    return rclc_parameter_client_refuse(
      client, RCL_RET_ERROR, MICROROS_ERROR_WORDS("a response with another number of results"));
  }
  for (size_t i = 0; i < client->count; ++i) {
    const char * reason = "";

    if (!parameter_outcome_read(client, i, &reason)) {
      return microros_error_named(
        RCLC_PARAMETER_MODIFICATION_REJECTED, microros_error_parameter_client_rejected, reason);
    }
  }
  return RCL_RET_OK;
}
