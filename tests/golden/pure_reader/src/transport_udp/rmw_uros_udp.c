/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/init_options.h"

#include "microros/error.h"

#include <stdbool.h>
#include <string.h>

/* A decimal number of 1 to 65535, without leading zeros. */
static bool options_is_port(const char * text)
{
  uint32_t value = 0;

  for (const char * at = text; *at != '\0'; ++at) {
    if (*at < '0' || *at > '9' || value > 6553u) {
      return false;
    }
    value = value * 10u + (uint32_t)(*at - '0');
  }
  return value != 0u && value <= 65535u && text[0] != '0';
}

rmw_ret_t rmw_uros_options_set_udp_address(
  const char * ip, const char * port, rmw_init_options_t * rmw_options)
{
  if (ip == NULL || port == NULL || rmw_options == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "ip, port or rmw_options");
  }
  if (ip[0] == '\0' || strlen(ip) >= RMW_UXRCE_MAX_HOST_SIZE || !options_is_port(port)) {
    microros_error_set(microros_error_address, ip, port, 0, RMW_UXRCE_MAX_HOST_SIZE - 1u);
    return RMW_RET_INVALID_ARGUMENT;
  }
  (void)memcpy(rmw_options->transport_params.agent_address, ip, strlen(ip) + 1u);
  (void)memcpy(rmw_options->transport_params.agent_port, port, strlen(port) + 1u);
  return RMW_RET_OK;
}
