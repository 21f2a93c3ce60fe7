/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_TCP_HOOKS_H
#define MICROROS_XRCE_TCP_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A closed connection ends its session; the next CREATE_CLIENT uses a new one. */
static inline void xrce_tcp_check(xrce_client_t * client, uint32_t now)
{
  xrce_session_t * session = &client->session;

  if (session->transport_open && xrce_transport_is_broken(&session->transport)) {
    xrce_transport_close(&session->transport); /* the port has no socket any more; keys are wiped */
    session->transport_open = false;
    if (session->state == (uint8_t)XRCE_READY) {
      xrce_session_mark_lost(client, now);
    }
  }
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TCP_HOOKS_H */
