/* SPDX-License-Identifier: Apache-2.0 */
/* Discovery of an agent without an address: not needed, the plan has one. A component with discovery
 * replaces this header. Internal. */
#ifndef MICROROS_RMW_PING_SEARCH_H
#define MICROROS_RMW_PING_SEARCH_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rmw_transport_params.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline bool rmw_ping_searches(const rmw_uxrce_transport_params_t * params)
{
  (void)params;
  return false;
}

/* Searches for at most `timeout_ms`; an agent that is found has also answered the ping. */
static inline rmw_ret_t rmw_ping_search(const rmw_uxrce_transport_params_t * params, uint32_t timeout_ms)
{
  (void)params;
  (void)timeout_ms;
  return RMW_RET_ERROR;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PING_SEARCH_H */
