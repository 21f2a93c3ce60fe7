/* SPDX-License-Identifier: Apache-2.0 */
/* The agent's time on the device. */
#ifndef MICROROS_RMW_MICROROS_TIME_SYNC_H
#define MICROROS_RMW_MICROROS_TIME_SYNC_H

#include <stdbool.h>
#include <stdint.h>

#include "rmw/init_options.h"
#include "rmw/ret_types.h"
#include "rmw_microxrcedds_c/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Asks the agent what time it is and keeps the difference to the time since the start of the device: right to half of the
 * time that question and answer took. What is lost is asked again, and a session that was lost is waited for; waits at most
 * `timeout_ms`, which must be longer than a round trip. RMW_RET_ERROR: there is no session, or no answer; then an earlier
 * result holds on. The result outlives a lost session, not rcl_shutdown.
 */
rmw_ret_t rmw_uros_sync_session(const int timeout_ms);

/* Returns whether rmw_uros_sync_session has succeeded. */
bool rmw_uros_epoch_synchronized(void);

/* Return the time since 1970-01-01 00:00 UTC as the agent has it; before it was asked, since the start of the device;
 * 0 without a context. */
int64_t rmw_uros_epoch_millis(void);
int64_t rmw_uros_epoch_nanos(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_TIME_SYNC_H */
