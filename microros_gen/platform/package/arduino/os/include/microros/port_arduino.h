/* SPDX-License-Identifier: Apache-2.0 */
/* Additions of boards with an Arduino core to microros/port.h. One task calls all of them, unless noted otherwise. */
#ifndef MICROROS_PORT_ARDUINO_H
#define MICROROS_PORT_ARDUINO_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Sets the time of day: nanoseconds since 1970-01-01 00:00 UTC. Until then port_time_epoch_ns() returns 0.
 * Afterwards port_time_steady_ns() advances it. */
void port_arduino_epoch_set(int64_t now_ns);

/* Returns whether port_wake() was called since the last call; what waits for a transport ends then. */
bool port_arduino_woken(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_ARDUINO_H */
