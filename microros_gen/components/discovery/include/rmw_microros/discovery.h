/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Agents found by multicast. If microros.yaml names no agent (or sets `transport: {agent: discover}`),
 * every session searches by itself, also after a loss; no call is needed.
 */
#ifndef MICROROS_RMW_MICROROS_DISCOVERY_H
#define MICROROS_RMW_MICROROS_DISCOVERY_H

#include "rmw/init_options.h"
#include "rmw/ret_types.h"
#include "rmw_microxrcedds_c/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Writes address and port of the first agent that answers into the options, with or without a session.
 * Waits at most MICROROS_CONNECT_TIMEOUT_MS. RMW_RET_TIMEOUT if none answered and the options name no
 * agent; RMW_RET_INVALID_ARGUMENT for NULL.
 */
rmw_ret_t rmw_uros_discover_agent(rmw_init_options_t * rmw_options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_DISCOVERY_H */
