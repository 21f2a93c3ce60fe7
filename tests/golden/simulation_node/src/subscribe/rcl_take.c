/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_subscription.h"
#include "rcl/subscription.h"

static rcl_ret_t take_result(rmw_ret_t result, bool taken)
{
  if (result != RMW_RET_OK) {
    return result;
  }
  return taken ? RCL_RET_OK : RCL_RET_SUBSCRIPTION_TAKE_FAILED;
}

static void take_prepare(const rmw_subscription_t * subscription, rmw_message_info_t * info)
{
  rmw_subscription_pump(subscription);
  if (info != NULL) {
    rmw_subscription_describe(subscription, info);
  }
}

rcl_ret_t rcl_take(
  const rcl_subscription_t * subscription, void * ros_message, rmw_message_info_t * message_info,
  rmw_subscription_allocation_t * allocation)
{
  bool taken = false;
  rmw_ret_t result;

  (void)allocation;
  if (!rcl_subscription_is_valid(subscription)) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  if (ros_message == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "message");
  }
  microros_lock();
  take_prepare(subscription->impl, message_info);
  result = rmw_subscription_take(subscription->impl, ros_message, &taken);
  microros_unlock();
  return take_result(result, taken);
}

rcl_ret_t rcl_take_serialized_message(
  const rcl_subscription_t * subscription, rcl_serialized_message_t * serialized_message,
  rmw_message_info_t * message_info, rmw_subscription_allocation_t * allocation)
{
  bool taken = false;
  rmw_ret_t result;

  (void)allocation;
  if (!rcl_subscription_is_valid(subscription)) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  if (serialized_message == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "serialized_message");
  }
  microros_lock();
  take_prepare(subscription->impl, message_info);
  result = rmw_subscription_take_serialized(subscription->impl, serialized_message, &taken);
  microros_unlock();
  return take_result(result, taken);
}
