/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/xrce_client.h"

bool xrce_session_drain(xrce_client_t * client)
{
  const uint32_t start = port_time_ms();

  if (client->session.state != XRCE_READY) {
    return false;
  }
  client->session.state = XRCE_CLOSING; /* accept no further messages */
  for (;;) {
    xrce_session_pump(client);
    if (xrce_session_is_sent(&client->session)) {
      return true;
    }
    if (port_time_ms() - start >= client->close_timeout_ms) {
      return false;
    }
    microros_pause();
  }
}
