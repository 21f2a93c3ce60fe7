/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/rmw_client_wait.h"
#include "microros/xrce_session.h"

void rmw_client_pump(void)
{
  microros_lock();
  xrce_session_pump(rmw_client_instance());
  microros_unlock();
}
