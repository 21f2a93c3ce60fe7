/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_deadlines.h"

#include "microros/port.h"
#include "microros/xrce_deadline_of.h"
#include "microros/xrce_wire.h"

#include <stddef.h>
#include <string.h>

/* Outside of the client: a saved session restores no pointers of the application. Indexed as endpoints. */
static xrce_deadline_t deadlines[XRCE_DEADLINES];

xrce_deadline_t * xrce_deadline_at(uint16_t index)
{
  return &deadlines[index];
}

xrce_deadline_t * xrce_deadline_open(const xrce_endpoint_t * endpoint)
{
  xrce_deadline_t * deadline = xrce_deadline_at(endpoint->index);

  if (deadline->observed) {
    return NULL;
  }
  (void)memset(deadline, 0, sizeof(*deadline));
  deadline->period_ms = xrce_deadline_of(endpoint);
  deadline->observed = true;
  return deadline;
}

void xrce_deadline_meet(const xrce_client_t * client, uint16_t index)
{
  xrce_deadline_t * deadline = xrce_deadline_at(index);

  if (deadline->observed && deadline->period_ms != 0u) {
    xrce_deadlines_step(client, port_time_ms()); /* a late message does not undo a missed deadline */
    deadline->due_ms = port_time_ms() + deadline->period_ms;
    deadline->running = true;
  }
}

static void deadline_miss(xrce_deadline_t * deadline, uint32_t now)
{
  const uint32_t missed = (now - deadline->due_ms) / deadline->period_ms + 1u;

  deadline->total += missed;
  deadline->due_ms += missed * deadline->period_ms;
  if (deadline->callback != NULL) {
    deadline->callback(deadline->user_data, (size_t)missed);
  }
}

void xrce_deadlines_step(const xrce_client_t * client, uint32_t now)
{
  for (uint16_t i = 0; i < (uint16_t)XRCE_DEADLINES; ++i) {
    xrce_deadline_t * deadline = xrce_deadline_at(i);

    if (!client->states[MICROROS_NODES_MAX + i].wanted) {
      deadline->running = false; /* its entity was finalized */
    }
    if (deadline->running && xrce_is_due(now, deadline->due_ms)) {
      deadline_miss(deadline, now);
    }
  }
}

uint32_t xrce_deadlines_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  uint32_t least = left;

  (void)client;
  for (uint16_t i = 0; i < (uint16_t)XRCE_DEADLINES; ++i) {
    if (deadlines[i].running) {
      least = xrce_sooner(least, deadlines[i].due_ms, now);
    }
  }
  return least;
}
