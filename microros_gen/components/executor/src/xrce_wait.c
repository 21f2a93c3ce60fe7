/* SPDX-License-Identifier: Apache-2.0 */
/* One task, port transport. */
#include "microros/xrce_wait.h"

#include "microros/xrce_wait_left.h"

void xrce_wait(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t left = xrce_wait_left(client, timeout_ms);

  port_wait(client->session.transport_open ? xrce_transport_handle(&client->session.transport) : -1, left);
}
