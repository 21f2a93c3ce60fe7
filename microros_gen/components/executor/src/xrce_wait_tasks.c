/* SPDX-License-Identifier: Apache-2.0 */
/* Several tasks, port transport. */
#include "microros/xrce_wait.h"

#include "microros/lock.h"
#include "microros/xrce_wait_left.h"

/* Another task may take or close an entity and so give the session work without a wake-up; writes do wake
 * (xrce_tasks.h). This limits the delay. */
enum { WAIT_MOST_MS = 1000 };

void xrce_wait(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t most = timeout_ms < (uint32_t)WAIT_MOST_MS ? timeout_ms : (uint32_t)WAIT_MOST_MS;
  uint32_t left;
  intptr_t handle;

  microros_lock();
  left = xrce_wait_left(client, most);
  handle = client->session.transport_open ? xrce_transport_handle(&client->session.transport) : -1;
  ++client->waiting;
  microros_unlock();
  port_wait(handle, left);
  microros_lock();
  --client->waiting;
  microros_unlock();
}
