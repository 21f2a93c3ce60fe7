/* SPDX-License-Identifier: Apache-2.0 */
/* Several tasks, port transport. */
#include "microros/lock.h"
#include "microros/wake.h"
#include "microros/xrce_wait.h"
#include "microros/xrce_wait_left.h"

/* Returns the time that a wait may take. Other tasks may give the session something to do, which does not end each wait at
 * once (xrce_turn_change.h). What the session has to do is not for a task that does not run it. */
static uint32_t wait_left(const xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t longest_ms = xrce_turn_longest_ms(client);
  const uint32_t most_ms = timeout_ms < longest_ms ? timeout_ms : longest_ms;

  return xrce_turn_is_mine() ? xrce_wait_left(client, most_ms) : most_ms;
}

/* Returns what ends the wait of a task that runs the session; -1: nothing but a wake-up. */
static intptr_t wait_handle(const xrce_client_t * client)
{
  return xrce_turn_is_mine() && client->session.transport_open
           ? xrce_transport_handle(&client->session.transport)
           : -1;
}

/* Enters the wait, with the time and the handle for it; false: something may be ready. */
static bool wait_enter(
  xrce_client_t * client, uint32_t timeout_ms, const uint32_t * news, uint32_t * left_ms, intptr_t * handle)
{
  const bool enters = *news == microros_news() && !client->wakes;

  *left_ms = wait_left(client, timeout_ms);
  *handle = wait_handle(client);
  client->waiting = (uint8_t)(client->waiting + (enters ? 1u : 0u));
  return enters;
}

/* A wake-up ends one wait. Where it brought news, the others end one after the other. */
static void wait_leave(xrce_client_t * client, const uint32_t * news)
{
  --client->waiting;
  client->wakes = client->waiting != 0u && (client->wakes || *news != microros_news());
  if (client->wakes) {
    port_wake();
  }
}

void xrce_wait_news(xrce_client_t * client, uint32_t timeout_ms, uint32_t * news)
{
  uint32_t left_ms;
  intptr_t handle;
  bool enters;
  bool wakes;

  microros_lock();
  enters = wait_enter(client, timeout_ms, news, &left_ms, &handle);
  wakes = client->wakes;
  if (!enters) {
    *news = microros_news();
  }
  microros_unlock();
  if (enters) {
    port_wait(handle, left_ms);
    microros_lock();
    wait_leave(client, news);
    *news = microros_news();
    microros_unlock();
  } else if (wakes) {
    port_sleep_ms(1); /* the wake-ups are for the tasks that wait already */
  } else {
    /* this task looks again */
  }
}
