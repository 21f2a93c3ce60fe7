/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_loan.h"
#include "microros/rmw_subscription.h"
#include "rcl/subscription.h"

rcl_ret_t rcl_take_loaned_message(
  const rcl_subscription_t * subscription, void ** loaned_message, rmw_message_info_t * message_info,
  rmw_subscription_allocation_t * allocation)
{
  rmw_ret_t result;

  (void)allocation;
  if (!rcl_subscription_is_valid(subscription)) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  if (loaned_message == NULL || *loaned_message != NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "loaned_message");
  }
  if (!rmw_loan_is_possible(subscription->impl)) {
    return microros_error_refuse(RCL_RET_UNSUPPORTED, "subscription");
  }
  microros_lock();
  rmw_subscription_pump(subscription->impl);
  if (message_info != NULL) {
    rmw_subscription_describe(subscription->impl, message_info);
  }
  result = rmw_loan_take(subscription->impl, loaned_message);
  microros_unlock();
  if (result != RMW_RET_OK) {
    return result;
  }
  return *loaned_message != NULL ? RCL_RET_OK : RCL_RET_SUBSCRIPTION_TAKE_FAILED;
}

rcl_ret_t rcl_return_loaned_message_from_subscription(
  const rcl_subscription_t * subscription, void * loaned_message)
{
  if (!rcl_subscription_is_valid(subscription)) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  if (loaned_message == NULL || !rmw_loan_return(subscription->impl, loaned_message)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "loaned_message");
  }
  return RCL_RET_OK;
}
