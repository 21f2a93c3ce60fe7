/* SPDX-License-Identifier: Apache-2.0 */
/* How long calls wait for the agent. */
#ifndef MICROROS_RMW_MICROROS_TIMING_H
#define MICROROS_RMW_MICROROS_TIMING_H

#include "rmw/init.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How long node and publisher creation wait, in milliseconds (MICROROS_CREATE_TIMEOUT_MS at first). */
rmw_ret_t rmw_uros_set_context_entity_creation_session_timeout(rmw_context_t * context, int session_timeout);

/*
 * How long fini of a node or publisher, and the end of the session, wait, in milliseconds
 * (MICROROS_CLOSE_TIMEOUT_MS at first). With 0 they do not: what is to be deleted is deleted by later calls,
 * or with the session.
 */
rmw_ret_t rmw_uros_set_context_entity_destroy_session_timeout(rmw_context_t * context, int session_timeout);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_TIMING_H */
