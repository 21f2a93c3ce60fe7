/* SPDX-License-Identifier: Apache-2.0 */
/* Tasks of executors leave the session to its own task, and wait for their own events. Replaces the header of component
 * `executor`. Internal. */
#ifndef MICROROS_RMW_TURN_H
#define MICROROS_RMW_TURN_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the calling task may run the session: it is not that of an executor. */
bool rmw_turn_pumps(void);

/* Waits as xrce_wait_news does, but for the event of the calling task; false without waiting if it is not that of an
 * executor. */
bool rmw_turn_waits(uint32_t timeout_ms, uint32_t * news);

/* Returns whether the calling task is that of an executor, and is to end. */
bool rmw_turn_is_over(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TURN_H */
