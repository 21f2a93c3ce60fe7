/* SPDX-License-Identifier: Apache-2.0 */
/* The agent's time, for clocks; internal to the library. */
#ifndef MICROROS_RMW_EPOCH_H
#define MICROROS_RMW_EPOCH_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns nanoseconds since 1970-01-01 00:00 UTC: port_time_steady_ns plus the offset to the agent's time.
 * False, with nothing written: not synchronized in this session. */
bool rmw_epoch_now(int64_t * epoch_ns);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_EPOCH_H */
