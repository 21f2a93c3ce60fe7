/* SPDX-License-Identifier: Apache-2.0 */
/* The session seen from the application: an addition of this client to rmw_microros. */
#ifndef MICROROS_RMW_MICROROS_SESSION_H
#define MICROROS_RMW_MICROROS_SESSION_H

#include <stdbool.h>
#include <stdint.h>

#include "rmw/init.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Counters since rcl_init; each starts again at 0 after 2^32 - 1. */
typedef struct rmw_uros_statistics_t {
  uint32_t sent;      /* datagrams handed to the transport */
  uint32_t resent;    /* reliable datagrams sent again */
  uint32_t received;  /* datagrams that came in */
  uint32_t malformed; /* of these, thrown away in whole or in part */
  uint32_t
    dropped; /* messages that no stream took, or that made room for newer ones; samples that came and went so */
  uint32_t reconnects; /* sessions opened after one was lost */
  uint32_t refused;    /* creations that the agent refused while it re-created entities */
} rmw_uros_statistics_t;

rmw_ret_t rmw_uros_get_statistics(const rmw_context_t * context, rmw_uros_statistics_t * statistics);

/* Returns whether there is a session with the agent and every entity exists there. */
bool rmw_uros_is_connected(const rmw_context_t * context);

/* Carries the session on, without waiting: for loops that call nothing else of this library for long. */
rmw_ret_t rmw_uros_spin_once(rmw_context_t * context);

/* Waits until the agent has acknowledged every reliable message, and the line has carried the others. RMW_RET_TIMEOUT after `timeout_ms`. */
rmw_ret_t rmw_uros_flush(rmw_context_t * context, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SESSION_H */
