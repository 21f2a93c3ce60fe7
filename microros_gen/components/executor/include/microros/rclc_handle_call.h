/* SPDX-License-Identifier: Apache-2.0 */
/* How an executor calls the callback of a handle; a component that measures callbacks replaces this header. Internal. */
#ifndef MICROROS_RCLC_HANDLE_CALL_H
#define MICROROS_RCLC_HANDLE_CALL_H

#include "microros/executor_handles.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Calls the function `call` of the handle's kind. The callback may remove the handle. */
static inline rcl_ret_t rclc_handle_call(rclc_executor_handle_t * handle)
{
  return handle->kind->call(handle);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_HANDLE_CALL_H */
