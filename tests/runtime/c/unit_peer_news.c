/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The first reliable message to another board: a HEARTBEAT becomes due, of which a task that waits must learn, also where the
 * wake-up ends the wait of another one. So it counts as news.
 */
#include "unit.h"

#include <microros/lock.h>
#include <microros/rmw_client.h>
#include <microros/wake.h>
#include <microros/xrce_client.h>
#include <microros/xrce_peer.h>

#include <stdint.h>

enum { SIZE = 16 };

static uint32_t news_of_message(void)
{
  xrce_client_t * client = rmw_client_instance();
  uint32_t before;
  uint32_t after;

  microros_lock();
  before = microros_news();
  CHECK(xrce_peer_reserve(client, 0, true) != NULL);
  CHECK(xrce_peer_commit(client, 0, true, SIZE, 1));
  client->peers[0].unsent = 0; /* as if the line had taken it */
  after = microros_news();
  microros_unlock();
  return after - before;
}

int main(void)
{
  rmw_client_instance()->peers[0].ready = true;
  CHECK(news_of_message() != 0u);
  return 0;
}
