/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_agents_time.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

void xrce_agents_time_restart(xrce_client_t * client, uint32_t now)
{
  xrce_agents_time_t * time = &client->agents_time;
  xrce_time_sync_t * sync = &client->time_sync;

  if (time->changes == client->agents.changes) {
    return;
  }
  time->changes = client->agents.changes;
  if (sync->synchronized && !time->asks) {
    time->asks = true;
    xrce_time_sync_begin(sync);
  }
  /* Answers of the previous agent do not count any more, and no round trip to it is compared. */
  sync->since_ns = port_time_steady_ns();
  sync->round_trip_ns = INT64_MAX;
  time->replies = sync->replies;
  time->since_ms = now;
  time->due_ms = now;
}

void xrce_agents_time_step(xrce_client_t * client, uint32_t now)
{
  xrce_agents_time_t * time = &client->agents_time;

  if (!time->asks || client->session.state != (uint8_t)XRCE_READY) {
    return;
  }
  if (time->replies != client->time_sync.replies) {
    time->asks = false;
    xrce_time_sync_end(&client->time_sync);
  } else if (xrce_is_due(now, time->due_ms)) {
    xrce_time_sync_request(client);
    time->due_ms = now + xrce_session_short_pause(now - time->since_ms);
  } else {
    /* the agent still has time to answer */
  }
}

uint32_t xrce_agents_time_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  return client->agents_time.asks ? xrce_sooner(left, client->agents_time.due_ms, now) : left;
}
