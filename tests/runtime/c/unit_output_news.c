/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A wake-up that ends the wait of the wrong task, with the port of this file: one task waits long, another one briefly, and a third
 * one stores the first reliable message. The wake-up ends the short wait, after which that task looks no more. The long wait,
 * which knows nothing of the HEARTBEAT, has to end, too.
 */
#include "unit.h"

#include <microros/lock.h>
#include <microros/port.h>
#include <microros/rmw_client.h>
#include <microros/wake.h>
#include <microros/xrce_client.h>
#include <microros/xrce_routes.h>
#include <microros/xrce_wait.h>

#include <stdbool.h>
#include <stdint.h>

enum { SIZE = 16, SHORT_MS = 10, LONG_MS = 60000 };

static unsigned depth;
static bool is_woken;
static bool ends_long;

static void wait_ms(uint32_t timeout_ms)
{
  uint32_t news;

  microros_lock();
  news = microros_news();
  microros_unlock();
  xrce_wait_news(rmw_client_instance(), timeout_ms, &news);
}

static void store(void)
{
  xrce_client_t * client = rmw_client_instance();

  microros_lock();
  CHECK(xrce_route_reserve(client, true) != NULL);
  CHECK(xrce_route_commit(client, true, SIZE));
  microros_unlock();
}

/* Called within the long wait, then within the short one; a wake-up ends one of them, here the short one. */
void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  (void)timeout_ms;
  ++depth;
  if (depth == 1u) {
    wait_ms(SHORT_MS);
    ends_long = is_woken;
  } else {
    store();
    CHECK(is_woken);
  }
  is_woken = false;
}

void port_wake(void)
{
  is_woken = true;
}

int main(void)
{
  wait_ms(LONG_MS);
  CHECK(depth == 2u);
  CHECK(ends_long);
  return 0;
}
