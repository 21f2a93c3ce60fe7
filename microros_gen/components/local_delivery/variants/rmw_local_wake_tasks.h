/* SPDX-License-Identifier: Apache-2.0 */
/* Several tasks: one that waits for messages may have to take this one. Internal. */
#ifndef MICROROS_RMW_LOCAL_WAKE_H
#define MICROROS_RMW_LOCAL_WAKE_H

#include "microros/wake.h"

static inline void rmw_local_wake(void)
{
  microros_wake(); /* also while a task is between looking for messages and waiting */
}

#endif /* MICROROS_RMW_LOCAL_WAKE_H */
