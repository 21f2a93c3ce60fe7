/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_new_data.h"
#include "rcl/client.h"

rcl_ret_t rcl_client_set_on_new_response_callback(
  const rcl_client_t * client, rcl_event_callback_t callback, const void * user_data)
{
  if (!rcl_client_is_valid(client)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client");
  }
  rmw_new_data_set(client->impl->data, callback, user_data);
  return RCL_RET_OK;
}
