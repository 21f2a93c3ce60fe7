/* SPDX-License-Identifier: Apache-2.0 */
/* transport: udp */
#include "microros/xrce_wait.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

/* The sooner of two: in `left` ms, or at `due`. What is overdue was tried in vain just now: it has a millisecond. */
static uint32_t wait_sooner(uint32_t left, uint32_t due, uint32_t now)
{
  const uint32_t until = xrce_is_due(now, due) ? 1u : due - now;

  return until < left ? until : left;
}

static uint32_t wait_for_stream(const xrce_stream_reliable_t * stream, uint32_t left, uint32_t now)
{
  if (stream->held) {
    return wait_sooner(left, stream->due_ms, now);
  }
  if (xrce_stream_reliable_is_blocked(stream)) {
    return wait_sooner(left, now, now);
  }
  return xrce_stream_reliable_is_idle(stream) ? left : wait_sooner(left, stream->due_ms, now);
}

/* Returns how long the session can be left alone, `most` at most. */
static uint32_t wait_for_session(const xrce_client_t * client, uint32_t most)
{
  const xrce_session_t * session = &client->session;
  const uint32_t now = port_time_ms();
  uint32_t left = most;

  if (session->state != (uint8_t)XRCE_READY) {
    return session->state == (uint8_t)XRCE_CONNECTING ? wait_sooner(left, session->due_ms, now) : left;
  }
  left = wait_sooner(
    left, client->ping.unanswered != 0u ? client->ping.due_ms : session->heard_ms + MICROROS_LIVELINESS_PERIOD_MS,
    now);
  if (client->entities.pending) {
    left = wait_sooner(left, xrce_entities_waits(&client->entities) ? client->entities.due_ms : now, now);
  }
  left = wait_for_stream(&client->reliable, left, now);
  return left;
}

void xrce_wait(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t left = wait_for_session(client, timeout_ms);

  port_wait(client->session.transport_open ? client->session.transport.udp.handle : -1, left);
}
