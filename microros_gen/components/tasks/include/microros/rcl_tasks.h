/* SPDX-License-Identifier: Apache-2.0 */
/* Totals of all tasks since the program began, for a diagnosis. Internal. */
#ifndef MICROROS_RCL_TASKS_H
#define MICROROS_RCL_TASKS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Counts runs that ended after their deadline, and releases that were left out. The caller holds the lock. */
void rcl_tasks_count(uint32_t overruns, uint32_t missed);

/* Return the totals; the caller holds the lock. */
uint32_t rcl_tasks_overruns(void);
uint32_t rcl_tasks_missed(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_TASKS_H */
