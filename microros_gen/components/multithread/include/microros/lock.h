/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One lock for what tasks share. Whoever the application calls takes it for the whole call and gives it back where
 * the call waits; so there is one microros_lock around each microros_pause. Functions that do not wait may take it again.
 */
#ifndef MICROROS_LOCK_H
#define MICROROS_LOCK_H

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

/* Gives the lock back for a millisecond. */
void microros_lock_rest(void);

/* Waits a millisecond, in which other tasks may have the lock. */
static inline void microros_pause(void)
{
  microros_lock_rest();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_LOCK_H */
