/* SPDX-License-Identifier: Apache-2.0 */
/* What the tasks say of themselves, for the watchdog. Internal. */
#ifndef MICROROS_RCLC_TASKS_WATCH_H
#define MICROROS_RCLC_TASKS_WATCH_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Longest wait of a task without a period: each of them says that it goes on. */
enum { RCLC_TASKS_WAIT_MOST_MS = 1000 };

/* The task is about to start: from now on it may be late. The caller holds the lock of the library. */
void rclc_tasks_watch_begin(uint8_t task);

/* The task has ended: it is not late until it is started again. The caller holds the lock. */
void rclc_tasks_watch_end(uint8_t task);

/* The task has something to do since then, and is late when it has not ended within its deadline. The caller holds the lock. */
void rclc_tasks_watch_release(uint8_t task, uint32_t released_us);

/* A run has ended; the next release of a task with a period is then. */
void rclc_tasks_watch_period(uint8_t task, uint32_t next_us);

/* A task without a period begins a run now. */
void rclc_tasks_watch_run(uint8_t task);

/* A task without a period has nothing to do; it looks again after its longest wait. */
void rclc_tasks_watch_rest(uint8_t task);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_TASKS_WATCH_H */
