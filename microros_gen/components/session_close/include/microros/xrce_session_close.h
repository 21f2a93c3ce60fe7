/* SPDX-License-Identifier: Apache-2.0 */
/* Closes the session at the agent: DELETE of the client, answered by STATUS. Both use stream 0. */
#ifndef MICROROS_XRCE_SESSION_CLOSE_H
#define MICROROS_XRCE_SESSION_CLOSE_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sends DELETE, repeatedly until the agent answers or `timeout_ms` has passed (0: once). Does nothing
 * without a session. The local side stays open: call xrce_session_close next. */
void xrce_session_leave(xrce_client_t * client, uint32_t timeout_ms);

void xrce_session_leave_on_status(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SESSION_CLOSE_H */
