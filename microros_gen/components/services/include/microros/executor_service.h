/* SPDX-License-Identifier: Apache-2.0 */
/* Handles of services, for rclc/executor.h, which includes this file. */
#ifndef MICROROS_EXECUTOR_SERVICE_H
#define MICROROS_EXECUTOR_SERVICE_H

#include "rcl/service.h"
#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The callback fills `response_msg`, which is sent when it returns, even if it removed the service. A
 * request waits until the reliable stream has room for its reply. That slot is reserved while the callback
 * runs: its own publishing never takes the last one. */
rcl_ret_t rclc_executor_add_service(
  rclc_executor_t * executor, rcl_service_t * service, void * request_msg, void * response_msg,
  rclc_service_callback_t callback);

rcl_ret_t rclc_executor_add_service_with_request_id(
  rclc_executor_t * executor, rcl_service_t * service, void * request_msg, void * response_msg,
  rclc_service_callback_with_request_id_t callback);

rcl_ret_t rclc_executor_add_service_with_context(
  rclc_executor_t * executor, rcl_service_t * service, void * request_msg, void * response_msg,
  rclc_service_callback_with_context_t callback, void * context);

rcl_ret_t rclc_executor_remove_service(rclc_executor_t * executor, const rcl_service_t * service);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_EXECUTOR_SERVICE_H */
