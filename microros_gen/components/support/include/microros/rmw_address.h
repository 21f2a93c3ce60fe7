/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by transports with host and port; internal. */
#ifndef MICROROS_RMW_ADDRESS_H
#define MICROROS_RMW_ADDRESS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "microros/error.h"
#include "microros_config.h"
#include "rmw/init_options.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether this is a decimal number from 1 to 65535 without leading zeros. */
static inline bool rmw_address_is_port(const char * text)
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

/* Sets the agent's address in rmw_options: ip of at most RMW_UXRCE_MAX_HOST_SIZE - 1 characters, port 1 to
 * 65535; both are copied. RMW_RET_INVALID_ARGUMENT otherwise, or if one is NULL. */
static inline rmw_ret_t rmw_address_set(rmw_init_options_t * rmw_options, const char * ip, const char * port)
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

/* Returns the number of a valid port; that of the plan for "". */
static inline uint16_t rmw_address_port(const char * digits)
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

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_ADDRESS_H */
