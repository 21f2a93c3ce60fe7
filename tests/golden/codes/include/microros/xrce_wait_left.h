/* SPDX-License-Identifier: Apache-2.0 */
/* Time until the session has work to do, over all selected components with deadlines. Only for
 * xrce_wait*.c and rmw_client.c: a copy each. */
#ifndef MICROROS_XRCE_WAIT_LEFT_H
#define MICROROS_XRCE_WAIT_LEFT_H

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_entities_hooks.h"
#include "microros/xrce_liveliness_acknack_hooks.h"
#include "microros/xrce_stream_reliable_hooks.h"
#include "microros/xrce_wire.h"

/* Returns the time until the session has work to do, at most `most`. */
static inline uint32_t xrce_wait_left(const xrce_client_t * client, uint32_t most)
{
  const xrce_session_t * session = &client->session;
  const uint32_t now = port_time_ms();
  uint32_t left = most;

  if (session->state != (uint8_t)XRCE_READY) {
    return session->state == (uint8_t)XRCE_CONNECTING ? xrce_sooner(left, session->due_ms, now) : left;
  }
  left = xrce_entities_left(client, left, now);
  left = xrce_stream_reliable_left(client, left, now);
  left = xrce_liveliness_acknack_left(client, left, now);
  return left;
}

#endif /* MICROROS_XRCE_WAIT_LEFT_H */
