/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_session_spin.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/wake.h"
#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_session.h"
#include "microros/xrce_session_take.h"
#include "microros/xrce_turn.h"

/* Limits the messages of a call, so that a flood cannot keep the task from its other work. */
enum { MESSAGES_PER_SPIN = 32 };

/* Returns whether a message had arrived. */
static bool spin_receive(xrce_client_t * client)
{
  bool had_arrived = false;

  microros_lock();
  /* cppcheck-suppress knownConditionTrueFalse ; without a task for the session each task has the turn */
  if (xrce_turn_is_mine() && client->session.transport_open) {
    const uint32_t now = port_time_ms(); /* with the lock: never before a time that another task has noted */

    client->session.now_ms = now;
    xrce_transport_begin_turn(&client->session.transport);
    had_arrived = xrce_session_take(client, now);
  }
  microros_unlock();
  return had_arrived;
}

/* Does what is due. Unlike a pump it is no change for tasks that wait: they know what is due, and learn of what arrived. */
static void session_step(xrce_client_t * client)
{
  const uint32_t now = port_time_ms();

  client->session.now_ms = now;
  /* cppcheck-suppress knownConditionTrueFalse ; without a task for the session each task has the turn */
  if (xrce_turn_is_mine()) {
    xrce_transport_begin_turn(&client->session.transport);
    xrce_route_step(client, now);
  } else {
    xrce_turn_request(client);
  }
}

void xrce_session_spin(xrce_client_t * client)
{
  bool had_arrived = true;

  for (uint8_t i = 0; i < (uint8_t)MESSAGES_PER_SPIN && had_arrived; ++i) {
    had_arrived = spin_receive(client);
  }
  microros_lock();
  session_step(client);
  if (had_arrived) {
    microros_note(); /* the transport may have read further messages, which end no wait */
    xrce_turn_request(client);
  }
  microros_unlock();
}
