/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the serial line of this port and its wait function; internal. */
#ifndef MICROROS_PORT_POSIX_SERIAL_H
#define MICROROS_PORT_POSIX_SERIAL_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether output waits for room in the system; a wait then also ends when there is room. */
bool port_posix_serial_waits(int handle);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_POSIX_SERIAL_H */
