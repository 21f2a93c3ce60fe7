/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_turn_change.h"

#include "microros/port.h"
#include "microros/wake.h"
#include "microros/xrce_client.h"

#include <stdbool.h>

enum { TURN_LONGEST_MS = 3600000 };

static uint32_t turn_changed_ms; /* when another task last called the library */
static bool turn_has_changed;    /* less than XRCE_TURN_POLL_MS ago, as far as was looked */
static bool turn_rests;          /* a task may be in a long wait */

void xrce_turn_change(const xrce_client_t * client)
{
  turn_changed_ms = client->session.now_ms;
  turn_has_changed = true;
  if (turn_rests) {
    turn_rests = false;
    microros_note();
    port_wake();
  }
}

void xrce_turn_stored(const xrce_client_t * client)
{
  microros_note();
  if (client->waiting != 0u) {
    port_wake();
  }
}

uint32_t xrce_turn_longest_ms(const xrce_client_t * client)
{
  turn_has_changed =
    turn_has_changed && client->session.now_ms - turn_changed_ms < (uint32_t)XRCE_TURN_POLL_MS;
  turn_rests = turn_rests || !turn_has_changed;
  return turn_has_changed ? (uint32_t)XRCE_TURN_POLL_MS : (uint32_t)TURN_LONGEST_MS;
}
