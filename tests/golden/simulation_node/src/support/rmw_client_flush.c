/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client.h"

#include "microros/port.h"
#include "microros/xrce_routes.h"

bool rmw_client_flush(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();

  for (;;) {
    xrce_session_pump(client);
    if (xrce_route_unacknowledged(client) == 0u) {
      return true;
    }
    if (port_time_ms() - start >= timeout_ms) {
      return false;
    }
    port_sleep_ms(1);
  }
}
