/* SPDX-License-Identifier: Apache-2.0 */
/* Handles of clients, for rclc/executor.h, which includes this file. */
#ifndef MICROROS_EXECUTOR_CLIENT_H
#define MICROROS_EXECUTOR_CLIENT_H

#include "rcl/client.h"
#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The callback gets each reply in `response_msg`, as a subscription gets its message. */
rcl_ret_t rclc_executor_add_client(
  rclc_executor_t * executor, rcl_client_t * client, void * response_msg, rclc_client_callback_t callback);

rcl_ret_t rclc_executor_add_client_with_request_id(
  rclc_executor_t * executor, rcl_client_t * client, void * response_msg,
  rclc_client_callback_with_request_id_t callback);

rcl_ret_t rclc_executor_remove_client(rclc_executor_t * executor, const rcl_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_EXECUTOR_CLIENT_H */
