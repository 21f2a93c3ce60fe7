/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the session for a caller that does not hold the lock. Internal. */
#ifndef MICROROS_XRCE_SESSION_SPIN_H
#define MICROROS_XRCE_SESSION_SPIN_H

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Does what xrce_session_pump does, and lets another task have the lock after each message. */
void xrce_session_spin(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SESSION_SPIN_H */
