/* SPDX-License-Identifier: Apache-2.0 */
/* Discovery of an agent without an address. Replaces the header of component `ping`. Internal. */
#ifndef MICROROS_RMW_PING_SEARCH_H
#define MICROROS_RMW_PING_SEARCH_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rmw_discovery.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline bool rmw_ping_searches(const rmw_uxrce_transport_params_t * params)
{
  return params->agent_address[0] == '\0';
}

/* Searches for at most `timeout_ms`; an agent that is found has also answered the ping. */
static inline rmw_ret_t rmw_ping_search(const rmw_uxrce_transport_params_t * params, uint32_t timeout_ms)
{
  rmw_uxrce_transport_params_t found = *params;

  return rmw_discovery_find(&found, timeout_ms);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PING_SEARCH_H */
