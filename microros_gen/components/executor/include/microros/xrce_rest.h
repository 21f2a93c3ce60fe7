/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How a call that waits for the agent rests between two pumps. Replaces the header of component `session`.
 * Internal. */
#ifndef MICROROS_XRCE_REST_H
#define MICROROS_XRCE_REST_H

#include "microros/port.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Rests until data arrives, for at most a millisecond. */
static inline void xrce_rest(const xrce_client_t * client)
{
  const xrce_session_t * session = &client->session;

  port_wait(session->transport_open ? xrce_transport_handle(&session->transport) : -1, 1);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_REST_H */
