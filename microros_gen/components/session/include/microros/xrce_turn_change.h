/* SPDX-License-Identifier: Apache-2.0 */
/* What a task that waits for the line must learn of another one: nothing, since one task alone calls the library. A component
 * with several tasks replaces this header. The caller holds the lock of the library. Internal. */
#ifndef MICROROS_XRCE_TURN_CHANGE_H
#define MICROROS_XRCE_TURN_CHANGE_H

#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called when another task may have given the session something to do that no message shows. */
static inline void xrce_turn_change(const xrce_client_t * client)
{
  (void)client;
}

/* Called after something was stored that whoever receives and sends hands to the session: a wait ends for it. */
static inline void xrce_turn_stored(const xrce_client_t * client)
{
  (void)client;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TURN_CHANGE_H */
