/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the serial line of this port and its wait function; internal. */
#ifndef MICROROS_PORT_POSIX_SERIAL_H
#define MICROROS_PORT_POSIX_SERIAL_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Pause between two attempts to open a device that is gone. */
#define PORT_POSIX_SERIAL_RETRY_MS 250u

/* All functions: with the lock of the library. */

/* Returns whether output waits for room in the system; a wait then also ends when there is room. */
bool port_posix_serial_waits(int handle);

/* Returns how long a wait may take, at most `left_ms`: a lost device does not report that it has returned. At least 1 ms while a
 * line has no room. */
uint32_t port_posix_serial_left(uint32_t left_ms);

/* Sets the end of a pipe that ends a wait when output begins to wait for room. */
void port_posix_serial_set_wake(int end);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_POSIX_SERIAL_H */
