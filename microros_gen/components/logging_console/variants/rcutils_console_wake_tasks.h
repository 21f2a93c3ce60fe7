/* SPDX-License-Identifier: Apache-2.0 */
/* Whoever waits must learn that a line of the console was dropped: from then on it looks whether the console takes the report,
 * which no event tells. Internal. */
#ifndef MICROROS_RCUTILS_CONSOLE_WAKE_H
#define MICROROS_RCUTILS_CONSOLE_WAKE_H

#include "microros/wake.h"

/* Called with the lock. */
static inline void microros_console_wake(void)
{
  microros_note();
  port_wake();
}

#endif /* MICROROS_RCUTILS_CONSOLE_WAKE_H */
