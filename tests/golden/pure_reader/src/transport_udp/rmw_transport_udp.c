/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_transport.h"

#include "microros_config.h"

static uint16_t transport_port(const char * digits)
{
  uint16_t port = 0;

  if (digits[0] == '\0') {
    return MICROROS_AGENT_PORT;
  }
  for (const char * at = digits; *at != '\0'; ++at) {
    port = (uint16_t)(port * 10u + (uint16_t)(*at - '0'));
  }
  return port;
}

bool rmw_transport_prepare(xrce_transport_t * transport, const rmw_uxrce_transport_params_t * params)
{
  transport->host = params->agent_address[0] != '\0' ? params->agent_address : MICROROS_AGENT_HOST;
  transport->port = transport_port(params->agent_port);
  return true;
}
