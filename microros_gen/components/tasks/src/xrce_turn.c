/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_turn.h"

#include "microros/port.h"
#include "microros/port_tasks.h"
#include "microros/wake.h"
#include "microros/xrce_client.h"
#include "microros_config.h"

enum { TURN_LONGEST_MS = 3600000 };

static bool turn_rounds[MICROROS_TASKS]; /* tasks in a round of their executor */
static bool turn_is_taken;               /* the task of the session runs */
static bool turn_is_requested;           /* once is enough until it looks */
static bool turn_is_borrowed;            /* with the lock, by its holder */

bool xrce_turn_is_mine(void)
{
  return !turn_is_taken || turn_is_borrowed || port_task_self() == (uint8_t)MICROROS_TASKS - 1u;
}

bool xrce_turn_is_taken(void)
{
  return turn_is_taken;
}

bool xrce_turn_begin(xrce_client_t * client)
{
  const bool is_mine = xrce_turn_is_mine();

  if (!is_mine) {
    client->session.now_ms = port_time_ms();
  }
  return is_mine;
}

/* It counts as news, so that the task of the session does not begin to wait before it has seen it, and so that a task that
 * is woken in its place wakes it. */
void xrce_turn_request(const xrce_client_t * client)
{
  if (!turn_is_requested) {
    turn_is_requested = true;
    microros_note();
    if (client->waiting != 0u) {
      port_wake();
    }
  }
}

void xrce_turn_borrow(void)
{
  turn_is_borrowed = true;
}

void xrce_turn_return(const xrce_client_t * client)
{
  turn_is_borrowed = false;
  if (!xrce_turn_is_mine()) {
    xrce_turn_request(client);
  }
}

void xrce_turn_change(const xrce_client_t * client)
{
  const uint8_t task = port_task_self();

  if (!xrce_turn_is_mine() && !(task < (uint8_t)MICROROS_TASKS && turn_rounds[task])) {
    xrce_turn_request(client);
  }
}

void xrce_turn_set_round(bool is_in_round)
{
  const uint8_t task = port_task_self();

  if (task < (uint8_t)MICROROS_TASKS) {
    turn_rounds[task] = is_in_round;
  }
}

uint32_t xrce_turn_longest_ms(const xrce_client_t * client)
{
  (void)client;
  return turn_is_taken ? (uint32_t)TURN_LONGEST_MS : (uint32_t)XRCE_TURN_POLL_MS;
}

void xrce_turn_commit(const xrce_client_t * client)
{
  if (!xrce_turn_is_mine()) {
    xrce_turn_request(client);
  }
}

void xrce_turn_take(void)
{
  turn_is_taken = true;
}

void xrce_turn_leave(void)
{
  turn_is_taken = false;
}

void xrce_turn_see(void)
{
  turn_is_requested = false;
}

bool xrce_turn_is_requested(void)
{
  return turn_is_requested;
}
