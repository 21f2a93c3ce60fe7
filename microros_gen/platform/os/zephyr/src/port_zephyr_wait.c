/* SPDX-License-Identifier: Apache-2.0 */
/* One semaphore: it ends one wait, or the next one. Drivers call port_wake when something has arrived. */
#include "microros/port.h"
#include "microros/port_zephyr.h"

static K_SEM_DEFINE(event, 1, 1); /* given: the first wait lets the caller look for what has arrived before */

/* What arrives on any handle wakes. */
void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  (void)k_sem_take(&event, K_MSEC(timeout_ms)); /* an error: the time has passed */
}

void port_wake(void)
{
  k_sem_give(&event);
}
