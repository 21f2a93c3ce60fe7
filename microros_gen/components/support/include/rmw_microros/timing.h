/* SPDX-License-Identifier: Apache-2.0 */
/* Time-outs of calls that wait for the agent. */
#ifndef MICROROS_RMW_MICROROS_TIMING_H
#define MICROROS_RMW_MICROROS_TIMING_H

#include "rmw/init.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Time-out for creating nodes and endpoints, in milliseconds (initially MICROROS_CREATE_TIMEOUT_MS). */
rmw_ret_t rmw_uros_set_context_entity_creation_session_timeout(rmw_context_t * context, int session_timeout);

/*
 * Time-out for finalizing nodes and endpoints and for closing the session, in milliseconds (initially
 * MICROROS_CLOSE_TIMEOUT_MS). With 0 these calls do not wait: later calls, or the end of the session,
 * delete the objects.
 */
rmw_ret_t rmw_uros_set_context_entity_destroy_session_timeout(rmw_context_t * context, int session_timeout);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_TIMING_H */
