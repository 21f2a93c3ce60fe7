/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/rmw_subscription.h"

#include <stddef.h>

static rcl_ret_t subscription_look(
  const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  (void)look_again_ns; /* a sample wakes the executor */
  if (!rmw_subscription_is_open(handle->subscription->impl)) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  *is_ready = rmw_subscription_is_ready(handle->subscription->impl);
  return RCL_RET_OK;
}

static rcl_ret_t subscription_take(rclc_executor_handle_t * handle)
{
  if (!rmw_subscription_is_open(handle->subscription->impl)) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  return rmw_subscription_take(handle->subscription->impl, handle->data, &handle->data_available);
}

static rcl_ret_t subscription_call(rclc_executor_handle_t * handle)
{
  handle->callback.subscription(handle->data_available ? handle->data : NULL);
  return RCL_RET_OK;
}

static rcl_ret_t subscription_call_with_context(rclc_executor_handle_t * handle)
{
  handle->callback.subscription_with_context(
    handle->data_available ? handle->data : NULL, handle->callback_context);
  return RCL_RET_OK;
}

/* Returns a handle without its callback, or NULL. */
static rclc_executor_handle_t * subscription_add(
  rclc_executor_t * executor, rcl_subscription_t * subscription, void * msg,
  rclc_executor_handle_invocation_t invocation, rclc_executor_handle_type_t type,
  const rclc_handle_kind_t * kind)
{
  rclc_executor_handle_t * handle = rclc_executor_add_handle(executor, type, kind);

  if (handle != NULL) {
    handle->subscription = subscription;
    handle->data = msg;
    handle->invocation = invocation;
    ++executor->info.number_of_subscriptions;
    if (rcl_subscription_is_valid(subscription)) {
      rmw_subscription_bind(subscription->impl, msg);
    }
  }
  return handle;
}

rcl_ret_t rclc_executor_add_subscription(
  rclc_executor_t * executor, rcl_subscription_t * subscription, void * msg,
  rclc_subscription_callback_t callback, rclc_executor_handle_invocation_t invocation)
{
  static const rclc_handle_kind_t kind = {subscription_look, subscription_take, subscription_call};
  rclc_executor_handle_t * handle;

  if (executor == NULL || subscription == NULL || msg == NULL || callback == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor, subscription, msg or callback");
  }
  handle = subscription_add(executor, subscription, msg, invocation, RCLC_SUBSCRIPTION, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->callback.subscription = callback;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_add_subscription_with_context(
  rclc_executor_t * executor, rcl_subscription_t * subscription, void * msg,
  rclc_subscription_callback_with_context_t callback, void * context,
  rclc_executor_handle_invocation_t invocation)
{
  static const rclc_handle_kind_t kind = {
    subscription_look, subscription_take, subscription_call_with_context};
  rclc_executor_handle_t * handle;

  if (executor == NULL || subscription == NULL || msg == NULL || callback == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor, subscription, msg or callback");
  }
  handle = subscription_add(executor, subscription, msg, invocation, RCLC_SUBSCRIPTION_WITH_CONTEXT, &kind);
  if (handle == NULL) {
    return RCL_RET_ERROR;
  }
  handle->callback.subscription_with_context = callback;
  handle->callback_context = context;
  return RCL_RET_OK;
}

rcl_ret_t rclc_executor_remove_subscription(
  rclc_executor_t * executor, const rcl_subscription_t * subscription)
{
  const rcl_ret_t result = rclc_executor_remove_handle(executor, subscription);

  if (result == RCL_RET_OK) {
    --executor->info.number_of_subscriptions;
  }
  return result;
}
