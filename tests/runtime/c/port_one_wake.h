/* SPDX-License-Identifier: Apache-2.0 */
/* Waiting as on a system with a semaphore: port_wake ends one wait, and nothing else does. */
#ifndef PORT_ONE_WAKE_H
#define PORT_ONE_WAKE_H

/* Returns when as many tasks wait, and keeps them there. */
void one_wake_hold(unsigned tasks);
void one_wake_release(void);

#endif /* PORT_ONE_WAKE_H */
