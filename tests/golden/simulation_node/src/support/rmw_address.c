/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_address.h"

#include "microros/error.h"

#include <string.h>

rmw_ret_t rmw_address_set(rmw_init_options_t * rmw_options, const char * ip, const char * port)
{
  if (ip == NULL || port == NULL || rmw_options == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "ip, port or rmw_options");
  }
  if (ip[0] == '\0' || strlen(ip) >= RMW_UXRCE_MAX_HOST_SIZE || !rmw_address_is_port(port)) {
    microros_error_set(microros_error_address, ip, port, 0, RMW_UXRCE_MAX_HOST_SIZE - 1u);
    return RMW_RET_INVALID_ARGUMENT;
  }
  (void)memcpy(rmw_options->transport_params.agent_address, ip, strlen(ip) + 1u);
  (void)memcpy(rmw_options->transport_params.agent_port, port, strlen(port) + 1u);
  return RMW_RET_OK;
}
