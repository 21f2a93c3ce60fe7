/* SPDX-License-Identifier: Apache-2.0 */
/* Part of rcl/subscription.h. */
#ifndef MICROROS_SUBSCRIPTION_NEW_DATA_H
#define MICROROS_SUBSCRIPTION_NEW_DATA_H

#include "rcl/subscription.h"
#include "rcl/event_callback.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sets the function that is called when messages have arrived, with their number; at once if some wait already.
 * NULL: none. It runs in the task that runs the session, while that holds the lock of the library: it must
 * not wait, and of the library it may call only rcl_trigger_guard_condition. `user_data` must stay valid
 * until rcl_subscription_fini or until another function is set. RCL_RET_INVALID_ARGUMENT for an invalid subscription.
 */
rcl_ret_t rcl_subscription_set_on_new_message_callback(
  const rcl_subscription_t * subscription, rcl_event_callback_t callback, const void * user_data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_SUBSCRIPTION_NEW_DATA_H */
