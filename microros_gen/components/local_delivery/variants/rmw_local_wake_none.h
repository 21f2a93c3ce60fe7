/* SPDX-License-Identifier: Apache-2.0 */
/* One task: whoever publishes does not wait. Internal. */
#ifndef MICROROS_RMW_LOCAL_WAKE_H
#define MICROROS_RMW_LOCAL_WAKE_H

#include "microros/xrce_forward.h"

static inline void rmw_local_wake(const xrce_client_t * client)
{
  (void)client;
}

#endif /* MICROROS_RMW_LOCAL_WAKE_H */
