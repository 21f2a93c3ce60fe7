/* SPDX-License-Identifier: Apache-2.0 */
/* The session, for the application: an addition of this client to rmw_microros. */
#ifndef MICROROS_RMW_MICROROS_SESSION_H
#define MICROROS_RMW_MICROROS_SESSION_H

#include <stdbool.h>
#include <stdint.h>

#include "rmw/init.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Counters since rcl_init; each wraps to 0 after 2^32 - 1. */
typedef struct rmw_uros_statistics_t {
  uint32_t sent;      /* datagrams passed to the transport */
  uint32_t resent;    /* reliable datagrams sent again */
  uint32_t received;  /* received datagrams */
  uint32_t malformed; /* of these, discarded in whole or in part */
  uint32_t
    dropped; /* messages that no stream accepted or that newer ones replaced; likewise received samples */
  uint32_t reconnects; /* sessions opened after a loss */
  uint32_t refused;    /* creations that the agent refused while entities were re-created */
} rmw_uros_statistics_t;

rmw_ret_t rmw_uros_get_statistics(const rmw_context_t * context, rmw_uros_statistics_t * statistics);

/* Returns whether a session is open and every entity exists at the agent. */
bool rmw_uros_is_connected(const rmw_context_t * context);

/* Runs the session without waiting: for loops that otherwise do not call this library for a long time. */
rmw_ret_t rmw_uros_spin_once(rmw_context_t * context);

/*
 * Writes the time in nanoseconds until the session has something to do, such as a repetition or a ping; INT64_MAX: not before
 * a message arrives or the application calls the library. For an application that sleeps itself: call it after
 * rmw_uros_spin_once, sleep at most so long, and let what arrives on the line end the sleep. */
rmw_ret_t rmw_uros_time_until_due(const rmw_context_t * context, int64_t * duration_ns);

/*
 * Waits until the agent has acknowledged every reliable message that was published before the call, and the transport has
 * sent the best-effort ones. RMW_RET_TIMEOUT after `timeout_ms`. What other tasks publish meanwhile does not prolong it,
 * except that a serial line (or the buffer before a custom transport) has to be idle for a moment. After a reconnection the
 * messages that the last agent did not acknowledge are sent again, and the call waits for those, if necessary also for a few
 * later ones (fewer than the stream has slots). A message that `on_full: drop_oldest` drops is not waited for. */
rmw_ret_t rmw_uros_flush(rmw_context_t * context, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SESSION_H */
