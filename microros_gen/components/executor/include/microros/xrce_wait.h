/* SPDX-License-Identifier: Apache-2.0 */
/* Resting while no work is due. */
#ifndef MICROROS_XRCE_WAIT_H
#define MICROROS_XRCE_WAIT_H

#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Waits until data may have arrived, until port_wake, or for `timeout_ms`; never longer than until the
 * session has work to do. May return early: pump the session and look again. A custom transport waits in
 * its read function during that pump, in steps of at most XRCE_WAIT_CUSTOM_MS.
 */
void xrce_wait(xrce_client_t * client, uint32_t timeout_ms);

/*
 * The same where several tasks call the library. `*news`: microros_news before this task last looked; returns at once if
 * it has changed since, and brings it up to date.
 */
void xrce_wait_news(xrce_client_t * client, uint32_t timeout_ms, uint32_t * news);

enum { XRCE_WAIT_CUSTOM_MS = 10 };

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_WAIT_H */
