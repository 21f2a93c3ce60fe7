/* SPDX-License-Identifier: Apache-2.0 */
/* Checks whether an agent is reachable. */
#ifndef MICROROS_RMW_MICROROS_PING_H
#define MICROROS_RMW_MICROROS_PING_H

#include <stdint.h>

#include "rmw/init_options.h"
#include "rmw/ret_types.h"
#include "rmw_microxrcedds_c/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sends up to `attempts` requests and waits `timeout_ms` for each answer; a late answer to an earlier
 * request counts. From rcl_init to rcl_shutdown it uses the session's transport, also during reconnection,
 * and an answer then speeds up connecting; otherwise it opens a separate transport to the agent of the
 * plan. RMW_RET_OK: an agent answered.
 */
rmw_ret_t rmw_uros_ping_agent(const int timeout_ms, const uint8_t attempts);

/* Same for the agent that the options name: over the session's transport if they name its serial line,
 * its functions of a custom transport or, with `seal`, its agent, otherwise over a separate one.
 * RMW_RET_INVALID_ARGUMENT for NULL. */
rmw_ret_t rmw_uros_ping_agent_options(
  const int timeout_ms, const uint8_t attempts, rmw_init_options_t * rmw_options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_PING_H */
