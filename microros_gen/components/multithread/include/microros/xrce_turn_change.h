/* SPDX-License-Identifier: Apache-2.0 */
/* What a task that waits for the line must learn of another one. The caller holds the lock of the library. Internal. */
#ifndef MICROROS_XRCE_TURN_CHANGE_H
#define MICROROS_XRCE_TURN_CHANGE_H

#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { XRCE_TURN_POLL_MS = 1000 };

/* Called when another task may have given the session something to do that no message shows: ends a wait that may be too
 * long for it. */
void xrce_turn_change(const xrce_client_t * client);

/* Returns the longest wait for the line, milliseconds: XRCE_TURN_POLL_MS where other tasks call the library, so that not each
 * of their calls has to end it; otherwise an hour. */
uint32_t xrce_turn_longest_ms(const xrce_client_t * client);

/* Called after something was stored that whoever receives and sends hands to the session: no wait begins before that was
 * seen, and one that has begun ends. */
void xrce_turn_stored(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TURN_CHANGE_H */
