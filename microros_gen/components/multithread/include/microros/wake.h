/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wakes every task that waits, after something became ready for one of them. port_wake ends one wait; each task whose
 * wait ends and that has not seen all news wakes the next one (xrce_wait_tasks.c). Internal.
 */
#ifndef MICROROS_WAKE_H
#define MICROROS_WAKE_H

#include <stdint.h>

#include "microros/port.h"
#include "microros/shared_flag.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A wake-up that microros_news has not counted. An interrupt cannot take the lock, and two that add to one counter at
 * once can make it go back. */
extern microros_shared_flag_t microros_is_woken;

/* Counts news, without waking a task. Called with the lock. */
void microros_note(void);

/* Returns the number of news modulo 2^32. Called with the lock, before looking at what may be new. */
uint32_t microros_news(void);

/* Callable from any task and from an interrupt. */
static inline void microros_wake(void)
{
  microros_flag_set(&microros_is_woken); /* first: whoever is woken sees it */
  port_wake();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_WAKE_H */
