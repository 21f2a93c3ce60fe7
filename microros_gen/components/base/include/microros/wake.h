/* SPDX-License-Identifier: Apache-2.0 */
/* Wakes the task that waits, after something became ready for it. Internal. */
#ifndef MICROROS_WAKE_H
#define MICROROS_WAKE_H

#include "microros/port.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Callable from any task and from an interrupt. */
static inline void microros_wake(void)
{
  port_wake();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_WAKE_H */
