/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the files of this port that wait and wake. Internal. */
#ifndef MICROROS_PORT_BARE_WAIT_H
#define MICROROS_PORT_BARE_WAIT_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether port_wake was called since the last call. */
bool port_bare_woken(void);

/* Returns whether bytes of the serial line wait to be read. */
bool port_bare_serial_arrived(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_BARE_WAIT_H */
