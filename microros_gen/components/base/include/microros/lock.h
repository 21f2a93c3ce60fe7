/* SPDX-License-Identifier: Apache-2.0 */
/* One task calls the library (the component multithread is not selected): there is nothing to lock. */
#ifndef MICROROS_LOCK_H
#define MICROROS_LOCK_H

#include "microros/port.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline void microros_lock(void)
{
}

static inline void microros_unlock(void)
{
}

/* Waits a millisecond, in which other tasks may have the lock. */
static inline void microros_pause(void)
{
  port_sleep_ms(1);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_LOCK_H */
