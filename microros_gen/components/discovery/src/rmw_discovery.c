/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/discovery.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_discovery.h"
#include "microros/rmw_inquiry.h"
#include "microros/rmw_transport.h"
#include "microros/xrce_discovery.h"
#include "microros_config.h"

#include <stdbool.h>
#include <string.h>

/* Time that an agent has to answer at a locator. */
enum { PLACE_MS = 2 * MICROROS_RETRY_FIRST_MS };

static bool discovery_reaches(const rmw_uxrce_transport_params_t * params)
{
  xrce_transport_t transport;

  rmw_inquiry_await();
  return rmw_transport_prepare(&transport, params) && rmw_inquiry_run(&transport, PLACE_MS, 1);
}

static void discovery_put_port(char * digits, uint16_t port)
{
  uint16_t unit = 10000;

  while (port < unit) {
    unit = (uint16_t)(unit / 10u);
  }
  for (; unit != 0u; unit = (uint16_t)(unit / 10u)) {
    *digits++ = (char)('0' + (char)(port / unit % 10u));
  }
  *digits = '\0';
}

/* Tries the next locator; clears the options if no agent answers there. */
static bool discovery_try_next(xrce_discovery_t * search, rmw_uxrce_transport_params_t * params)
{
  const uint16_t port = xrce_discovery_take(search);

  (void)memcpy(params->agent_address, search->host, strlen(search->host) + 1u);
  discovery_put_port(params->agent_port, port);
  if (discovery_reaches(params)) {
    return true;
  }
  params->agent_address[0] = '\0';
  params->agent_port[0] = '\0';
  return false;
}

rmw_ret_t rmw_discovery_find(rmw_uxrce_transport_params_t * params, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  xrce_discovery_t search;
  bool found = false;

  (void)memset(&search, 0, sizeof(search));
  params->agent_address[0] = '\0';
  params->agent_port[0] = '\0';
  while (!found && port_time_ms() - start < timeout_ms) {
    if (xrce_discovery_search(&search, port_time_ms())) {
      found = discovery_try_next(&search, params);
    } else {
      microros_pause();
    }
  }
  xrce_discovery_end(&search);
  if (!found) {
    microros_error_set(
      microros_error_agent_silent, XRCE_DISCOVERY_GROUP, NULL, MICROROS_DISCOVERY_PORT, timeout_ms);
    return RMW_RET_TIMEOUT;
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_uros_discover_agent(rmw_init_options_t * rmw_options)
{
  rmw_ret_t result;

  if (rmw_options == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "rmw_options");
  }
  microros_lock();
  result = rmw_discovery_find(&rmw_options->transport_params, MICROROS_CONNECT_TIMEOUT_MS);
  microros_unlock();
  return result;
}
