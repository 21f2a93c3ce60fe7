/* SPDX-License-Identifier: Apache-2.0 */
/* Which tasks of executors wait, and what released them, and which task has the line. The caller holds the lock of the
 * library, except for the last three functions. Internal. */
#ifndef MICROROS_RMW_TASKS_H
#define MICROROS_RMW_TASKS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Says that a task goes on; nothing has released it yet. */
void rmw_tasks_begin(uint8_t task);

/* Says that a task is to end: it does not wait any more, and nobody ends its wait but the caller. */
void rmw_tasks_end(uint8_t task);

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

/* The calling task, that of the session, begins and ends to be the only one that receives and sends. */
void rmw_tasks_take_line(void);
void rmw_tasks_leave_line(void);

/* Writes a message whose transport may wait; only the task of the session calls it. Returns whether there was one. */
bool rmw_tasks_write(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TASKS_H */
