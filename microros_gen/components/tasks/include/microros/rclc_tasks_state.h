/* SPDX-License-Identifier: Apache-2.0 */
/* State of the tasks, shared by the functions that start them and those that run in them. Internal. */
#ifndef MICROROS_RCLC_TASKS_STATE_H
#define MICROROS_RCLC_TASKS_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/tasks.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Only the task itself uses its state while it runs; the lock of the library guards the counters,
 * `is_in_round`, `continues`, `is_made` and `stack_peak`. */
typedef struct rclc_task_state_t {
  rclc_executor_t * executor;
  rclc_task_callback_t callback;
  rclc_task_overrun_callback_t on_overrun;
  rclc_task_counters_t counters;
  uint32_t next_us;     /* the next release of a task with a period */
  uint32_t released_us; /* the release of a run in progress */
  uint32_t began_us;
  uint32_t stack_peak; /* of a task that was joined, bytes */
  bool has_run;        /* a round since the last look; tasks without a period */
  bool is_in_round;    /* a callback may wait for anything; tasks without a period */
  bool continues;      /* it is not to end */
  bool is_made;        /* and not joined: the port may be asked */
} rclc_task_state_t;

extern rclc_task_state_t rclc_task_states[MICROROS_TASKS];

/* Returns whether the task goes on. */
bool rclc_tasks_continue(uint8_t task);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_TASKS_STATE_H */
