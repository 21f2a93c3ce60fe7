/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_address.h"
#include "microros/rmw_transport.h"
#include "microros_config.h"
#include "rmw_microros/init_options.h"

#include <string.h>

bool rmw_transport_prepare(xrce_transport_t * transport, const rmw_uxrce_transport_params_t * params)
{
  (void)memset(transport, 0, sizeof(*transport));
  transport->host = params->agent_address[0] != '\0' ? params->agent_address : MICROROS_AGENT_HOST;
  transport->port = rmw_address_port(params->agent_port);
  return true;
}

rmw_ret_t rmw_uros_options_set_tcp_address(
  const char * ip, const char * port, rmw_init_options_t * rmw_options)
{
  return rmw_address_set(rmw_options, ip, port);
}
