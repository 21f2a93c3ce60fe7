/* SPDX-License-Identifier: Apache-2.0 */
/* The watchdog of the device (capability `watchdog`), which the application has: its time and its start are the device's. */
#ifndef MICROROS_PORT_WATCHDOG_H
#define MICROROS_PORT_WATCHDOG_H

#ifdef __cplusplus
extern "C" {
#endif

/* Feeds the watchdog. Called in any of the tasks, by one at a time; the caller holds the lock of the library, so it is short. */
void port_watchdog_feed(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_WATCHDOG_H */
