/* SPDX-License-Identifier: Apache-2.0 */
/* Single-task variant (component `multithread` is not selected): locking compiles to nothing. */
#ifndef MICROROS_LOCK_H
#define MICROROS_LOCK_H

#include <stdbool.h>

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

/* No task keeps the lock while a callback may be called. */
static inline void microros_lock_silence(bool is_silent)
{
  (void)is_silent;
}

static inline bool microros_lock_is_silent(void)
{
  return false;
}

/* Sleeps one millisecond so that other tasks can take the lock. */
static inline void microros_pause(void)
{
  port_sleep_ms(1);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_LOCK_H */
