/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client_wait.h"

#include "microros/rmw_client.h"
#include "microros/xrce_wait.h"

void rmw_client_wait_news(uint32_t timeout_ms, uint32_t * news)
{
  xrce_wait_news(rmw_client_instance(), timeout_ms, news);
}
