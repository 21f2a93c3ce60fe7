/* SPDX-License-Identifier: Apache-2.0 */
/* Hook called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_ACTION_CLIENT_HOOKS_H
#define MICROROS_XRCE_ACTION_CLIENT_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The agent's requesters are new: what they had asked for gets no reply. */
static inline void xrce_action_client_renew(xrce_client_t * client)
{
  ++client->action_client_sessions;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ACTION_CLIENT_HOOKS_H */
