/* SPDX-License-Identifier: Apache-2.0 */
/* Part of rcl/client.h. */
#ifndef MICROROS_CLIENT_NEW_DATA_H
#define MICROROS_CLIENT_NEW_DATA_H

#include "rcl/client.h"
#include "rcl/event_callback.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sets the function that is called when responses have arrived, with their number; at once if some wait already.
 * NULL: none. It runs in the task that runs the session, while that holds the lock of the library: it must
 * not wait, and of the library it may call only rcl_trigger_guard_condition. `user_data` must stay valid
 * until rcl_client_fini or until another function is set. RCL_RET_INVALID_ARGUMENT for an invalid client.
 */
rcl_ret_t rcl_client_set_on_new_response_callback(
  const rcl_client_t * client, rcl_event_callback_t callback, const void * user_data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_CLIENT_NEW_DATA_H */
