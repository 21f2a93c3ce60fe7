/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/session_state.h"

#include "microros/xrce_client.h"

#include <stddef.h>

static rmw_uros_session_callback_t chosen; /* set by rmw_uros_set_session_callback */
static void * chosen_argument;

static void state_report(const xrce_client_t * client)
{
  static const rmw_uros_session_state_t states[5] = {
    [XRCE_WATCH_CLOSED] = RMW_UROS_SESSION_CLOSED,
    [XRCE_WATCH_CONNECTING] = RMW_UROS_SESSION_CONNECTING,
    [XRCE_WATCH_CONNECTED] = RMW_UROS_SESSION_CONNECTED,
    [XRCE_WATCH_LOST] = RMW_UROS_SESSION_LOST,
    [XRCE_WATCH_RECONNECTING] = RMW_UROS_SESSION_RECONNECTING,
  };
  static const rmw_uros_session_reason_t reasons[6] = {
    [XRCE_WATCH_NO_REASON] = RMW_UROS_REASON_NONE,
    [XRCE_WATCH_SILENT] = RMW_UROS_REASON_SILENT,
    [XRCE_WATCH_FORGOTTEN] = RMW_UROS_REASON_FORGOTTEN,
    [XRCE_WATCH_UNACKNOWLEDGED] = RMW_UROS_REASON_UNACKNOWLEDGED,
    [XRCE_WATCH_BROKEN] = RMW_UROS_REASON_BROKEN,
    [XRCE_WATCH_REFUSED] = RMW_UROS_REASON_REFUSED,
  };
  const rmw_uros_session_event_t event = {
    .state = states[client->watch.state],
    .reason = reasons[client->watch.reason],
    .losses = client->watch.losses,
    .reconnects = client->session.statistics.reconnects,
    .dropped = client->session.statistics.dropped,
  };

  if (chosen != NULL) {
    chosen(&event, chosen_argument);
  }
}

rmw_ret_t rmw_uros_set_session_callback(rmw_uros_session_callback_t callback, void * argument)
{
  chosen = callback;
  chosen_argument = argument;
  xrce_watch_set_listener(state_report);
  return RMW_RET_OK;
}
