/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_new_data.h"
#include "rcl/subscription.h"

rcl_ret_t rcl_subscription_set_on_new_message_callback(
  const rcl_subscription_t * subscription, rcl_event_callback_t callback, const void * user_data)
{
  if (!rcl_subscription_is_valid(subscription)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "subscription");
  }
  rmw_new_data_set(subscription->impl->data, callback, user_data);
  return RCL_RET_OK;
}
