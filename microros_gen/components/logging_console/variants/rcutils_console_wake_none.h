/* SPDX-License-Identifier: Apache-2.0 */
/* Whoever waits must learn that a line of the console was dropped: no task waits while this one logs. Internal. */
#ifndef MICROROS_RCUTILS_CONSOLE_WAKE_H
#define MICROROS_RCUTILS_CONSOLE_WAKE_H

static inline void microros_console_wake(void)
{
}

#endif /* MICROROS_RCUTILS_CONSOLE_WAKE_H */
