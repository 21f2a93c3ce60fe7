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
 * Asks the agent for its time and stores the offset to the time since the start of the device, with an
 * error of at most half a round trip. Repeats lost requests and waits for a lost session; waits for at
 * most `timeout_ms`, which must be longer than a round trip. RMW_RET_ERROR: no session, or no answer; an
 * earlier result then stays valid. The result survives a lost session, but not rcl_shutdown.
 */
rmw_ret_t rmw_uros_sync_session(const int timeout_ms);

/* Returns whether rmw_uros_sync_session has succeeded. */
bool rmw_uros_epoch_synchronized(void);

/* Return the agent's time since 1970-01-01 00:00 UTC; before synchronization, the time since the start of
 * the device; 0 without a context. */
int64_t rmw_uros_epoch_millis(void);
int64_t rmw_uros_epoch_nanos(void);

/*
 * Writes the same time as a builtin_interfaces/msg/Time has it, with one reading of the clock:
 * rmw_uros_epoch_stamp(&msg.header.stamp.sec, &msg.header.stamp.nanosec). Returns whether it is the agent's
 * time. False, with nothing written, for NULL, without a context, and for times from 2038-01-19 03:14:08 UTC
 * on, which the type cannot express.
 */
bool rmw_uros_epoch_stamp(int32_t * sec, uint32_t * nanosec);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_TIME_SYNC_H */
