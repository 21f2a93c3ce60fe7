/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_new_data.h"
#include "rcl/service.h"

rcl_ret_t rcl_service_set_on_new_request_callback(
  const rcl_service_t * service, rcl_event_callback_t callback, const void * user_data)
{
  if (!rcl_service_is_valid(service)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "service");
  }
  rmw_new_data_set(service->impl->data, callback, user_data);
  return RCL_RET_OK;
}
