/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_tasks.h"
#include "microros/rclc_tasks_state.h"
#include "microros/tasks.h"

#include <stdbool.h>

/* The lock keeps the task from being joined meanwhile. */
rcl_ret_t rclc_task_set_priority(uint8_t task, uint8_t priority)
{
  bool is_set;

  if (task >= (uint8_t)MICROROS_TASKS || priority == 0u || priority > (uint8_t)MICROROS_TASKS) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "task or priority");
  }
  microros_lock();
  is_set = rclc_task_states[task].is_made &&
           port_task_set_priority(task, (uint8_t)((uint8_t)MICROROS_TASKS + 1u - priority));
  microros_unlock();
  return is_set ? RCL_RET_OK
                : microros_error_named(
                    RCL_RET_ERROR, microros_error_tasks, "it does not run, or the system has no priorities");
}
