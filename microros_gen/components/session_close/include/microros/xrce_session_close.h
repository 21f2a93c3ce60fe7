/* SPDX-License-Identifier: Apache-2.0 */
/* Taking leave of the agent: DELETE of the client, answered by STATUS. Both are on stream 0. */
#ifndef MICROROS_XRCE_SESSION_CLOSE_H
#define MICROROS_XRCE_SESSION_CLOSE_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Takes leave, repeated until the agent answers or `timeout_ms` are over (0: said once). Without a session it does
 * nothing. What is open stays: xrce_session_close follows. */
void xrce_session_leave(xrce_client_t * client, uint32_t timeout_ms);

void xrce_session_leave_on_status(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SESSION_CLOSE_H */
