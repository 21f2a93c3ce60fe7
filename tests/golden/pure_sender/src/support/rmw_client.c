/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client.h"

#include "microros/xrce_client.h"

#include <stddef.h>

const char * const rmw_implementation_identifier = "rmw_microros_gen";

static xrce_client_t instance;

xrce_client_t * rmw_client_instance(void)
{
  return &instance;
}

xrce_client_t * rmw_client_connected(void)
{
  return instance.session.state == XRCE_READY ? &instance : NULL;
}

const char * rmw_client_host(const rmw_uxrce_transport_params_t * params)
{
  return params->agent_address[0] != '\0' ? params->agent_address : MICROROS_AGENT_HOST;
}

uint16_t rmw_client_port(const rmw_uxrce_transport_params_t * params)
{
  uint16_t port = 0;

  if (params->agent_port[0] == '\0') {
    return MICROROS_AGENT_PORT;
  }
  for (const char * at = params->agent_port; *at != '\0'; ++at) {
    port = (uint16_t)(port * 10u + (uint16_t)(*at - '0'));
  }
  return port;
}
