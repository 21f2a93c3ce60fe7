/* SPDX-License-Identifier: Apache-2.0 */
/* There is no watchdog. Internal. */
#ifndef MICROROS_RCLC_TASKS_WATCH_H
#define MICROROS_RCLC_TASKS_WATCH_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Longest wait of a task without a period. What it waits for ends it. */
enum { RCLC_TASKS_WAIT_MOST_MS = 3600000 };

static inline void rclc_tasks_watch_begin(uint8_t task)
{
  (void)task;
}

static inline void rclc_tasks_watch_end(uint8_t task)
{
  (void)task;
}

static inline void rclc_tasks_watch_release(uint8_t task, uint32_t released_us)
{
  (void)task;
  (void)released_us;
}

static inline void rclc_tasks_watch_period(uint8_t task, uint32_t next_us)
{
  (void)task;
  (void)next_us;
}

static inline void rclc_tasks_watch_run(uint8_t task)
{
  (void)task;
}

static inline void rclc_tasks_watch_rest(uint8_t task)
{
  (void)task;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_TASKS_WATCH_H */
