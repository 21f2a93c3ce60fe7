/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the session for a caller that does not hold the lock. A component with several tasks replaces this header. Internal. */
#ifndef MICROROS_XRCE_SESSION_SPIN_H
#define MICROROS_XRCE_SESSION_SPIN_H

#include "microros/xrce_forward.h"
#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Does what xrce_session_pump does. */
static inline void xrce_session_spin(xrce_client_t * client)
{
  xrce_session_pump(client);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SESSION_SPIN_H */
