/* SPDX-License-Identifier: Apache-2.0 */
/* Resting while nothing is to be done. */
#ifndef MICROROS_XRCE_WAIT_H
#define MICROROS_XRCE_WAIT_H

#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Waits until something may have arrived, until port_wake, or for `timeout_ms`; never longer than until the session has
 * something to do. May come back early: pump the session and look. A custom transport does its waiting in that pump, with
 * its read function, in steps of XRCE_WAIT_CUSTOM_MS at most.
 */
void xrce_wait(xrce_client_t * client, uint32_t timeout_ms);

enum { XRCE_WAIT_CUSTOM_MS = 10 };

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_WAIT_H */
