/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wakes every task that waits, after something became ready for one of them. port_wake ends one wait; each task whose
 * wait ends and that has not seen all news wakes the next one (xrce_wait_tasks.c). Internal.
 */
#ifndef MICROROS_WAKE_H
#define MICROROS_WAKE_H

#include <stdint.h>

#include "microros/port.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Counts news modulo 2^32. Two that are counted at once may count as one: each waiting task looks after it all the same. */
extern volatile uint32_t microros_news;

/* Counts news, without waking a task. */
static inline void microros_note(void)
{
  microros_news = microros_news + 1u;
}

/* Callable from any task and from an interrupt. */
static inline void microros_wake(void)
{
  microros_note(); /* first: whoever is woken sees it */
  port_wake();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_WAKE_H */
