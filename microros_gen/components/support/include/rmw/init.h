/* SPDX-License-Identifier: Apache-2.0 */
/* A context: one session with one agent. */
#ifndef MICROROS_RMW_INIT_H
#define MICROROS_RMW_INIT_H

#include <stddef.h>
#include <stdint.h>

#include "rmw/init_options.h"
#include "rmw/macros.h"
#include "rmw/ret_types.h"
#include "rmw/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The XRCE client, owned by the library. */
typedef struct xrce_client_t rmw_context_impl_t;

typedef struct rmw_context_s {
  uint64_t instance_id;
  const char * implementation_identifier;
  rmw_init_options_t options;
  size_t actual_domain_id;
  rmw_context_impl_t * impl; /* NULL: not initialized, or shut down */
} rmw_context_t;

rmw_context_t rmw_get_zero_initialized_context(void);

/*
 * Opens the transport and waits for the agent, at most MICROROS_CONNECT_TIMEOUT_MS. RMW_RET_TIMEOUT: no
 * agent answered; RMW_RET_ERROR: the agent refused, or the transport did not open.
 */
rmw_ret_t rmw_init(const rmw_init_options_t * options, rmw_context_t * context);

/*
 * Closes the session at the agent, waiting for at most MICROROS_CLOSE_TIMEOUT_MS, and closes the
 * transport. */
rmw_ret_t rmw_shutdown(rmw_context_t * context);

rmw_ret_t rmw_context_fini(rmw_context_t * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_INIT_H */
