/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client_wait.h"

#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/xrce_session.h"
#include "microros/xrce_wait.h"

void rmw_client_pump(void)
{
  microros_lock();
  xrce_session_pump(rmw_client_instance());
  microros_unlock();
}

void rmw_client_wait(uint32_t timeout_ms)
{
  xrce_wait(rmw_client_instance(), timeout_ms);
}
