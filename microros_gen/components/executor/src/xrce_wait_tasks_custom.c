/* SPDX-License-Identifier: Apache-2.0 */
/* Several tasks, custom transport: its read function must not wait, since it would hold the lock. */
#include "microros/lock.h"
#include "microros/xrce_wait.h"
#include "microros/xrce_wait_left.h"

void xrce_wait_news(xrce_client_t * client, uint32_t timeout_ms, uint32_t * news)
{
  uint32_t left;

  (void)news; /* every task looks after each millisecond */
  microros_lock();
  left = xrce_wait_left(client, timeout_ms);
  microros_unlock();
  port_sleep_ms(left != 0u ? 1u : 0u);
}
