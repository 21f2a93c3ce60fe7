/* SPDX-License-Identifier: Apache-2.0 */
/* A ping without a session asks all agents of the list. Replaces the header of component `ping`. Internal. */
#ifndef MICROROS_RMW_PING_SEARCH_H
#define MICROROS_RMW_PING_SEARCH_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rmw_agents_chosen.h"
#include "microros/rmw_transport_params.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline bool rmw_ping_searches(const rmw_uxrce_transport_params_t * params)
{
  return !rmw_agents_is_chosen(params);
}

/*
 * Asks one agent after the other, each for its part of `timeout_ms`. RMW_RET_ERROR, with a text, if none
 * answers. The caller holds the lock, which is released while this function waits. */
rmw_ret_t rmw_ping_search(const rmw_uxrce_transport_params_t * params, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PING_SEARCH_H */
