/* SPDX-License-Identifier: Apache-2.0 */
/* Part of rcl/service.h. */
#ifndef MICROROS_SERVICE_NEW_DATA_H
#define MICROROS_SERVICE_NEW_DATA_H

#include "rcl/service.h"
#include "rcl/event_callback.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sets the function that is called when requests have arrived, with their number; at once if some wait already.
 * NULL: none. It runs in the task that runs the session, while that holds the lock of the library: it must
 * not wait, and of the library it may call only rcl_trigger_guard_condition. `user_data` must stay valid
 * until rcl_service_fini or until another function is set. RCL_RET_INVALID_ARGUMENT for an invalid service.
 */
rcl_ret_t rcl_service_set_on_new_request_callback(
  const rcl_service_t * service, rcl_event_callback_t callback, const void * user_data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_SERVICE_NEW_DATA_H */
