/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/executor_handle.h"

#include "microros/error.h"
#include "microros/executor_handles.h"

#include <string.h>

rcl_ret_t rclc_executor_handle_counters_zero_init(rclc_executor_handle_counters_t * handle_counters)
{
  if (handle_counters == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "handle_counters");
  }
  (void)memset(handle_counters, 0, sizeof(*handle_counters));
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_handle_init(rclc_executor_handle_t * handle, size_t max_handles)
{
  if (handle == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "handle");
  }
  (void)memset(handle, 0, sizeof(*handle));
  handle->type = RCLC_NONE;
  handle->invocation = ON_NEW_DATA;
  handle->index = max_handles;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_handle_clear(rclc_executor_handle_t * handle, size_t max_handles)
{
  if (handle == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "handle");
  }
  handle->index = max_handles;
  handle->initialized = false;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_handle_print(rclc_executor_handle_t * handle)
{
  return handle != NULL ? RCL_RET_OK : microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "handle");
}

rcl_ret_t rclc_handle_take_nothing(rclc_executor_handle_t * handle)
{
  (void)handle;
  return RCL_RET_OK;
}

/* At most one pointer is set; an unused handle has none. */
void * rclc_executor_handle_get_ptr(rclc_executor_handle_t * handle)
{
  if (handle == NULL) {
    return NULL;
  }
  if (handle->client != NULL) {
    return handle->client;
  }
  if (handle->service != NULL) {
    return handle->service;
  }
  return handle->gc;
}
