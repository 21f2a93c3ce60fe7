/* SPDX-License-Identifier: Apache-2.0 */
/* What the application file says of the tasks, and the functions of hooks. Internal. */
#ifndef MICROROS_RCLC_TASKS_H
#define MICROROS_RCLC_TASKS_H

#include <stdint.h>

#include "microros/port_tasks.h"
#include "microros/tasks.h"
#include "microros_config.h"
#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum rclc_task_overrun_t { RCLC_TASK_SKIP, RCLC_TASK_CATCH_UP, RCLC_TASK_CALL } rclc_task_overrun_t;

/* Times are microseconds; 0: none. A task without a period is released by what becomes ready in its executor. */
typedef struct rclc_task_plan_t {
  uint32_t period_us;
  uint32_t interval_us;
  uint32_t deadline_us;
  rclc_task_overrun_t overrun;
} rclc_task_plan_t;

/* The last one is the session. */
extern const rclc_task_plan_t rclc_task_plans[MICROROS_TASKS];
extern const port_task_t rclc_task_settings[MICROROS_TASKS];

/* Called by an executor before and after the callbacks of a round. */
void rclc_tasks_round_begins(const rclc_executor_t * executor);
void rclc_tasks_round_ends(const rclc_executor_t * executor);

/* Entries of the tasks. */
void rclc_tasks_run_period(uint8_t task);
void rclc_tasks_run_events(uint8_t task);
void rclc_tasks_run_session(uint8_t task);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_TASKS_H */
