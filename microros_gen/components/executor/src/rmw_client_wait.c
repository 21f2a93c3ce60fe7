/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client_wait.h"

#include "microros/rmw_client.h"
#include "microros/xrce_wait.h"

void rmw_client_wait(uint32_t timeout_ms)
{
  xrce_wait(rmw_client_instance(), timeout_ms);
}
