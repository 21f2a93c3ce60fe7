/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_watch.h"

#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"

#include <stdbool.h>
#include <stddef.h>

static xrce_watch_listener_t watch_listener; /* outlives the client, which is zeroed by each rcl_init */

void xrce_watch_set_listener(xrce_watch_listener_t listener)
{
  watch_listener = listener;
}

/* Returns why a session that was ready was lost. */
static xrce_watch_reason_t watch_reason(const xrce_client_t * client)
{
  if (xrce_transport_is_broken(&client->session.transport)) {
    return XRCE_WATCH_BROKEN;
  }
  /* Lost right after a message: the agent said so; otherwise it was silent. */
  return client->session.received_ms == client->session.now_ms ? XRCE_WATCH_FORGOTTEN : XRCE_WATCH_SILENT;
}

/* Returns the state to report, given the last reported one. */
static xrce_watch_state_t watch_look(const xrce_client_t * client)
{
  const xrce_session_t * session = &client->session;
  const xrce_watch_state_t last = (xrce_watch_state_t)client->watch.state;

  if (session->state == (uint8_t)XRCE_CONNECTING) {
    return session->was_ready ? XRCE_WATCH_LOST : XRCE_WATCH_CONNECTING;
  }
  if (session->state != (uint8_t)XRCE_READY) {
    return XRCE_WATCH_CLOSED;
  }
  if ((last == XRCE_WATCH_LOST || last == XRCE_WATCH_RECONNECTING) && !xrce_route_settled(client)) {
    return XRCE_WATCH_RECONNECTING;
  }
  return XRCE_WATCH_CONNECTED;
}

void xrce_watch_step(xrce_client_t * client)
{
  xrce_watch_t * watch = &client->watch;
  const xrce_watch_state_t seen = watch_look(client);
  const uint8_t state = (uint8_t)seen;
  xrce_watch_reason_t reason = XRCE_WATCH_NO_REASON;

  if (state == (uint8_t)XRCE_WATCH_LOST) {
    reason = (xrce_watch_reason_t)watch->reason;
    if (state != watch->state) {
      reason = watch_reason(client);
      ++watch->losses;
    } else if (client->session.refusal != 0u) {
      reason = XRCE_WATCH_REFUSED;
    } else {
      /* no answer yet */
    }
  }
  if (state == watch->state && (uint8_t)reason == watch->reason) {
    return;
  }
  watch->state = state;
  watch->reason = (uint8_t)reason;
  if (watch_listener != NULL) {
    watch_listener(client);
  }
}
