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

/* A WRITE_DATA submessage was removed from the stream. The request in it is not outstanding any more. */
void xrce_action_client_drop(xrce_client_t * client, const uint8_t * dropped);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ACTION_CLIENT_HOOKS_H */
