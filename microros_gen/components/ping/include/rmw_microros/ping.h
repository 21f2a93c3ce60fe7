/* SPDX-License-Identifier: Apache-2.0 */
/* Is an agent there? */
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
 * Asks `attempts` times and waits `timeout_ms` for each answer; a late one to an earlier question counts. From rcl_init to
 * rcl_shutdown it asks over the transport of the session, also while that is looked for, and an answer then makes
 * the session connect sooner; else over a transport of its own to the agent of the plan. RMW_RET_OK: an agent answered.
 */
rmw_ret_t rmw_uros_ping_agent(const int timeout_ms, const uint8_t attempts);

/* The same, to the agent that the options name: over the transport of the session where they name its serial line, or its
 * functions of a custom transport, else over one of its own. RMW_RET_INVALID_ARGUMENT for NULL. */
rmw_ret_t rmw_uros_ping_agent_options(
  const int timeout_ms, const uint8_t attempts, rmw_init_options_t * rmw_options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_PING_H */
