/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_rest.h"
#include "microros/xrce_routes.h"

bool rmw_client_flush(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  bool flushed;

  microros_lock();
  for (;;) {
    xrce_session_pump(client);
    flushed = xrce_route_unacknowledged(client) == 0u && xrce_session_is_sent(&client->session);
    if (flushed || port_time_ms() - start >= timeout_ms) {
      break;
    }
    xrce_rest(client);
  }
  microros_unlock();
  return flushed;
}
