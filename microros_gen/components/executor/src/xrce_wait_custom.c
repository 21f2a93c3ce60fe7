/* SPDX-License-Identifier: Apache-2.0 */
/* One task, custom transport: its read function waits during the pump that follows. */
#include "microros/xrce_wait.h"

#include "microros/xrce_wait_left.h"

void xrce_wait(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t left = xrce_wait_left(client, timeout_ms);
  const uint32_t step = left < (uint32_t)XRCE_WAIT_CUSTOM_MS ? left : (uint32_t)XRCE_WAIT_CUSTOM_MS;

  if (client->session.transport_open) {
    client->session.transport.wait_ms = (uint8_t)step;
  } else {
    port_sleep_ms(step);
  }
}
