/* SPDX-License-Identifier: Apache-2.0 */
/* Measures how long callbacks take. Internal. */
#ifndef MICROROS_RCLC_HANDLE_CALL_H
#define MICROROS_RCLC_HANDLE_CALL_H

#include "microros/executor_handles.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Calls the function `call` of the handle's kind, and notes its time if the application watches this entity. The callback
 * may remove the handle. */
rcl_ret_t rclc_handle_call(rclc_executor_handle_t * handle);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_HANDLE_CALL_H */
