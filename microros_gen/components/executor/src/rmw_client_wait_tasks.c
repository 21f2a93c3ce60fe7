/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client_wait.h"

#include "microros/rmw_client.h"
#include "microros/rmw_turn.h"
#include "microros/xrce_wait.h"

void rmw_client_wait_news(uint32_t timeout_ms, uint32_t * news)
{
  /* cppcheck-suppress knownConditionTrueFalse ; without tasks of the application file every task waits for the line */
  if (!rmw_turn_waits(timeout_ms, news)) {
    xrce_wait_news(rmw_client_instance(), timeout_ms, news);
  }
}
