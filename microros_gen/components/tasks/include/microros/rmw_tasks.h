/* SPDX-License-Identifier: Apache-2.0 */
/* Which tasks of executors wait, and what released them. The caller holds the lock of the library. Internal. */
#ifndef MICROROS_RMW_TASKS_H
#define MICROROS_RMW_TASKS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Says whether tasks of executors go on, or are to end. */
void rmw_tasks_set_running(bool is_running);

/* Returns whether the task waits for its event. While the caller holds the lock, the task stays in that wait and so does
 * not change its executor. */
bool rmw_tasks_waits(uint8_t task);

/* Returns when the wait of a task that waits ends by itself, as port_time_ms counts. */
uint32_t rmw_tasks_until_ms(uint8_t task);

/* Ends the wait of a task that waits, which looks again. */
void rmw_tasks_wake(uint8_t task);

/* Ends the wait of a task that waits; `now_us` is the time of its release. */
void rmw_tasks_release(uint8_t task, uint32_t now_us);

/* Returns when the task was released, and forgets it; `now_us` if nobody released it since the last call. */
uint32_t rmw_tasks_released(uint8_t task, uint32_t now_us);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TASKS_H */
