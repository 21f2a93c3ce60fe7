/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Agents that are searched for by multicast. Where microros.yaml names no agent (or `transport: {agent: discover}`), every
 * session does so by itself, also after a loss; then nothing has to be called.
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
 * Writes address and port of the first agent that answers into the options, whether there is a session or not. Waits for
 * one at most MICROROS_CONNECT_TIMEOUT_MS.
 * RMW_RET_TIMEOUT: none did, and the options name no agent; RMW_RET_INVALID_ARGUMENT for NULL.
 */
rmw_ret_t rmw_uros_discover_agent(rmw_init_options_t * rmw_options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_DISCOVERY_H */
