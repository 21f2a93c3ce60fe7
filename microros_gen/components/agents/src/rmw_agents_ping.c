/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_inquiry.h"
#include "microros/rmw_ping_search.h"
#include "microros/rmw_transport.h"
#include "microros/xrce_agents.h"
#include "microros_config.h"

#include <stddef.h>

rmw_ret_t rmw_ping_search(const rmw_uxrce_transport_params_t * params, uint32_t timeout_ms)
{
  xrce_transport_t transport;

  for (uint8_t index = 0; index < MICROROS_AGENTS; ++index) {
    rmw_inquiry_await();
    if (!rmw_transport_prepare(&transport, params)) {
      return RMW_RET_ERROR;
    }
    xrce_agents_set(&transport, index);
    if (rmw_inquiry_run(&transport, timeout_ms / MICROROS_AGENTS, 1)) {
      return RMW_RET_OK;
    }
  }
  microros_error_set(
    microros_error_agent_silent, xrce_transport_name(&transport), NULL, xrce_transport_port(&transport),
    timeout_ms);
  return RMW_RET_ERROR;
}
