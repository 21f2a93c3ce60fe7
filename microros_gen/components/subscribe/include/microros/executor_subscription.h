/* SPDX-License-Identifier: Apache-2.0 */
/* Handles of subscriptions, for rclc/executor.h, which includes this file. */
#ifndef MICROROS_EXECUTOR_SUBSCRIPTION_H
#define MICROROS_EXECUTOR_SUBSCRIPTION_H

#include "rcl/subscription.h"
#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * `msg` belongs to the user and receives the decoded samples; if none of its strings and sequences has a
 * buffer, they get the storage of the subscription's declaration. The callback may use it until it
 * returns. RCL_RET_INVALID_ARGUMENT for NULL, RCL_RET_ERROR if all handles are in use.
 */
rcl_ret_t rclc_executor_add_subscription(
  rclc_executor_t * executor, rcl_subscription_t * subscription, void * msg,
  rclc_subscription_callback_t callback, rclc_executor_handle_invocation_t invocation);

/* `context` is passed to the callback and may be NULL. */
rcl_ret_t rclc_executor_add_subscription_with_context(
  rclc_executor_t * executor, rcl_subscription_t * subscription, void * msg,
  rclc_subscription_callback_with_context_t callback, void * context,
  rclc_executor_handle_invocation_t invocation);

rcl_ret_t rclc_executor_remove_subscription(
  rclc_executor_t * executor, const rcl_subscription_t * subscription);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_EXECUTOR_SUBSCRIPTION_H */
