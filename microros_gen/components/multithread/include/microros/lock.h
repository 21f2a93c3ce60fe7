/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One lock for everything that tasks share. Every public function takes it for its whole duration and
 * releases it while it waits, so each microros_pause is inside exactly one microros_lock. Functions that
 * do not wait may take it recursively.
 */
#ifndef MICROROS_LOCK_H
#define MICROROS_LOCK_H

#include <stdbool.h>

#include "microros/port.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline void microros_lock(void)
{
  port_lock();
}

static inline void microros_unlock(void)
{
  port_unlock();
}

/* True while the task with the lock reads clocks: the time then does not follow a source, which would call jump callbacks. */
extern bool microros_lock_silent;

/* Both are called with the lock; the first again with false before the lock is released. */
static inline void microros_lock_silence(bool is_silent)
{
  microros_lock_silent = is_silent;
}

static inline bool microros_lock_is_silent(void)
{
  return microros_lock_silent;
}

/* Releases the lock for a millisecond. */
void microros_lock_rest(void);

/* Sleeps one millisecond so that other tasks can take the lock. */
static inline void microros_pause(void)
{
  microros_lock_rest();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_LOCK_H */
