/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"
#include "rmw_microros/on_silence.h"

#include <stdbool.h>
#include <stddef.h>

uint32_t rmw_uros_silences(void)
{
  const xrce_client_t * client = rmw_client_instance();
  uint32_t count = 0;
  bool is_open;

  microros_lock();
  is_open = client->session.state != (uint8_t)XRCE_CLOSED;
  for (size_t i = 0; i < MICROROS_SILENCES; ++i) {
    count += (is_open && client->silences[i].is_silent) ? 1u : 0u;
  }
  microros_unlock();
  return count;
}
