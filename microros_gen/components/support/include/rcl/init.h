/* SPDX-License-Identifier: Apache-2.0 */
/* Opening and closing a session. */
#ifndef MICROROS_RCL_INIT_H
#define MICROROS_RCL_INIT_H

#include "microros_config.h"
#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/init_options.h"
#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Waits for the agent, at most MICROROS_CONNECT_TIMEOUT_MS. `context` must be zero-initialized; arguments
 * are not read. RCL_RET_TIMEOUT: no agent answered; RCL_RET_ERROR: it refused, or another context is open;
 * RCL_RET_ALREADY_INIT. Afterwards a lost session recovers by itself: every call of this library runs it.
 */
rcl_ret_t rcl_init(
  int argc, char const * const * argv, const rcl_init_options_t * options, rcl_context_t * context);

/* Closes the session at the agent, waiting for at most MICROROS_CLOSE_TIMEOUT_MS, and frees all entities. */
rcl_ret_t rcl_shutdown(rcl_context_t * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_INIT_H */
